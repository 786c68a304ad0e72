// Latches of contacts whose history is lost, where a bed rests.
#pragma once

#include <functional>

#include "engine/plan/plan.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

// A bed that Walton and Braun's law has brought to rest lies on overlaps that impacts have left: with fresh
// contacts it would push as hard as in these impacts. So each fresh contact gets the largest overlap a_max
// that leaves it the share s of the force of a fresh one,
//
//   K1 a_max - K2 (a_max - a) = s K1 a,
//
// with the one s, at most 1, for which all contacts together carry the bed's weight. is_fresh says it of a
// kind of contact. The loop has been restarted.
void set_latches(const Plan& plan, const Surroundings& around, const Grains& grains,
                 const std::function<bool(const PairPlan&)>& is_fresh, StepLoop& loop);

}  // namespace grainreel
