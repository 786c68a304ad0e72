// Histories of contacts that a run takes over from the checkpoint it starts anew from.
#pragma once

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/start/bed_in_file.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

// The loop has been restarted with the grains of the scene's start file, a checkpoint. Contacts that touch
// now and did so then go on with their histories, where they follow the same law. Throws UserError where the
// checkpoint is damaged.
void take_histories(const Scene& scene, const Plan& plan, const Surroundings& around,
                    const StartOrigin& origin, const Grains& grains, StepLoop& loop);

// Whether all contacts of both plans, of so many species, act alike; or any of them.
bool all_act_alike(const Plan& one, const Plan& other);
bool any_act_alike(const Plan& one, const Plan& other);
// Whether the same kind of contact acts alike in `other`; `pair` is one of `one`.
bool acts_alike_in(const Plan& other, const Plan& one, const PairPlan& pair);

}  // namespace grainreel
