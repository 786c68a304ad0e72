#include "render/page/play/web_engine.hpp"

#include <fmt/format.h>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "engine/base/error.hpp"
#include "engine/base/system/own_files.hpp"
#include "engine/base/system/program.hpp"
#include "render/page/embed.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

constexpr const char *script_name = "page_engine.js", *wasm_name = "page_engine.wasm";

// The folders in which it may lie, the likeliest first.
std::vector<fs::path> places() {
    std::vector<fs::path> all;
    if (const char* named = std::getenv("GRAINREEL_WEB_ENGINE")) all.emplace_back(named);
    if (!own_files().empty()) all.push_back(own_files() / "web");
    std::error_code none;
    const fs::path program = fs::read_symlink("/proc/self/exe", none);
    if (!none) {
        all.push_back(program.parent_path().parent_path() / "share" / "grainreel" / "web");  // of a package
        all.push_back(program.parent_path().parent_path() / "web");  // build/release, build/web
    }
    return all;
}

}  // namespace

WebEngine web_engine() {
    std::error_code none;
    for (const fs::path& place : places())
        if (fs::is_regular_file(place / script_name, none) && fs::is_regular_file(place / wasm_name, none))
            return {read_bytes(place / script_name), read_bytes(place / wasm_name)};
    throw UserError(
        fmt::format("play: the engine for browsers is not there; in the source tree './movie play' builds it "
                    "once (it installs "
                    "Debian's emscripten), elsewhere GRAINREEL_WEB_ENGINE names the folder with {} and {}",
                    script_name, wasm_name));
}

}  // namespace grainreel
