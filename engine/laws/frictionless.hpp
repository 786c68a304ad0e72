// No tangential force: no history, no torque, no spin.
#pragma once

#include <string_view>

#include "engine/scene/plan.hpp"

namespace grainreel {

struct Frictionless {
    static constexpr std::string_view name = "none";
    static constexpr bool rubs = false;

    struct Parameters {
        explicit Parameters(const PairPlan&) {}
    };
    struct History {};
};

}  // namespace grainreel
