// FlowedOut is how many grains have left a run, and their mass, as outflow.csv and films tell it.
#pragma once

#include <cstdint>

namespace grainreel {

struct FlowedOut {
    std::int64_t grains = 0;
    double mass = 0;  // kg
};

}  // namespace grainreel
