// Histories of contacts that a run takes over from the checkpoint it starts from, and histories in place of
// lost ones.
#pragma once

#include <functional>

#include "engine/base/vector.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/start/bed_in_file.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/contact_view.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

// Gives contacts that touch now, and touched in the checkpoint too, their histories from there if they
// follow the same law. The loop has been restarted with the grains of the scene's start file, which is a
// checkpoint. Throws UserError where the checkpoint is damaged.
void take_histories(const Scene& scene, const Plan& plan, const Surroundings& around,
                    const StartOrigin& origin, const Grains& grains, StepLoop& loop);

// Whether all kinds of contact, or any, act alike in both plans, which must have equally many species.
bool all_act_alike(const Plan& one, const Plan& other);
bool any_act_alike(const Plan& one, const Plan& other);
// Whether this kind of contact acts alike in `other`; `pair` belongs to `one`.
bool acts_alike_in(const Plan& other, const Plan& one, const PairPlan& pair);

// Latches for contacts whose history is lost, in a bed at rest: the largest overlap that a contact ever had,
// which Walton and Braun's law remembers.

// A bed that this law has brought to rest lies on overlaps that impacts have left. Fresh contacts would push
// as hard there as in these impacts. So each fresh contact gets the largest overlap a_max that leaves it the
// share s of the force of a fresh one,
//
//   K1 a_max - K2 (a_max - a) = s K1 a,
//
// with one s, at most 1, for all contacts, so that together they carry the bed's weight. is_fresh says
// which kinds of contact are fresh. The loop has been restarted.
void set_latches(const Plan& plan, const Surroundings& around, const Grains& grains,
                 const std::function<bool(const PairPlan&)>& is_fresh, StepLoop& loop);

// How much of the weight of a bed at rest each contact carries, by the virial theorem (Love 1927,
// Mathematical Theory of Elasticity, note B). The forces on a grain add up to zero. Multiply each sum by the
// grain's height and add all grains: the moments of all contact forces (force times height difference) equal
// those of the weights (weight times height). Friction, which carries the smaller part, is left out.

class WeightSums {
  public:
    WeightSums(const Vec3& gravity, const Grains& grains);
    double of_weights() const { return of_weights_; }  // J, sum of weight times height
    // How much of that sum a normal force of 1 N at this contact carries (m).
    double carried(const ContactView& contact) const;
    // Height above the lowest point of any grain (m).
    double height(const Vec3& place) const { return up_.dot(place) - lowest_; }

  private:
    const Grains& grains_;
    Vec3 up_{0, 0, 1};  // unit, against gravity
    double lowest_ = 0, of_weights_ = 0;
};

}  // namespace grainreel
