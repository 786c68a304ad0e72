// A key that `resume --accept` changed at a step of a run. Checkpoints from before have it as it was.
#pragma once

#include <cstdint>
#include <string>

namespace grainreel {

struct AcceptedKey {
    std::int64_t step = 0;
    std::string key, then, now;  // values as TOML; empty: not there
};

}  // namespace grainreel
