// The engine that was compiled for browsers (engine/web): where it lies, and its two files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace grainreel {

struct WebEngine {
    std::vector<std::uint8_t> script, wasm;  // of page_engine.js and page_engine.wasm
};

// Reads it: from the files of an unpacked archive or a package, or from build/web beside the program's own
// build. Throws UserError, with what to do, where there is none.
WebEngine web_engine();

}  // namespace grainreel
