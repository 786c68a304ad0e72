// One row of measures from the present state.
#pragma once

#include "engine/base/clock.hpp"
#include "engine/measure/measures.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

// The species of the largest and of the smallest mean diameter. All of one size: the first and the second.
// There must be two at least.
struct BigAndSmall {
    std::size_t big = 0, small = 0;
};
BigAndSmall big_and_small(const std::vector<Species>& species);

// start_energy: J, all energy at the start of the drive, for the balance.
Measures measure(const Scene& scene, const Clock& clock, const Surroundings& around, const Grains& grains,
                 const StepLoop& loop, std::int64_t step, double start_energy);

// J: kinetic, rotational, gravitational and elastic together.
double total_energy(const Surroundings& around, const Grains& grains, const StepLoop& loop,
                    std::int64_t step);

}  // namespace grainreel
