// Which contacts carry the weight of a bed at rest: the virial theorem (Love 1927, Mathematical Theory of
// Elasticity, note B). The forces on a grain add up to zero. Each force times the grain's height, summed over
// all grains: the moments of all contact forces, force times height difference, are those of the weights.
// Friction, which carries the smaller part, is left out.
#pragma once

#include "engine/base/vector.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/contact_view.hpp"

namespace grainreel {

class WeightMoments {
  public:
    WeightMoments(const Vec3& gravity, const Grains& grains);
    double of_weights() const { return of_weights_; }  // J
    // m: how much of it a normal force of 1 N at this contact carries.
    double carried(const ContactView& contact) const;
    // m, above the lowest point of any grain.
    double height(const Vec3& place) const { return up_.dot(place) - lowest_; }

  private:
    const Grains& grains_;
    Vec3 up_{0, 0, 1};  // unit, against gravity
    double lowest_ = 0, of_weights_ = 0;
};

}  // namespace grainreel
