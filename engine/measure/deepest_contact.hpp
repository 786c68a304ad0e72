// The contact of a run that overlapped most, among those that the checks of health and the rows of measures
// have seen. An impact between two looks may have overlapped more.
#pragma once

#include <cstdint>
#include <string>

namespace grainreel {

struct DeepestContact {
    double share = 0;  // overlap divided by the smaller radius; 0 where nothing touched
    std::int64_t step = 0;
    double time = 0;         // s
    std::int32_t grain = 0;  // id
    std::string species;     // of that grain
    std::string other;       // "grain 7", "the floor" or "\"plate\""
    std::string remedy;      // what may help; empty up to HealthLimits::told
    bool operator==(const DeepestContact&) const = default;
};

}  // namespace grainreel
