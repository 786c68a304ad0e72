// The drive: how far the moving faces are from rest, and how fast, at a given step.
#pragma once

#include <cstdint>

#include "engine/base/clock.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

class WallMotion {
  public:
    WallMotion() = default;  // at rest for ever
    WallMotion(const Drive& drive, const Clock& clock);

    bool moving() const { return amplitude_ > 0; }

    // z_w = a s(t) sin(wt + phi), v_w = a (s w cos(wt + phi) + s' sin(wt + phi)), with s rising from 0 to 1
    // over the ramp as 10u^3 - 15u^4 + 6u^5 (twice differentiable). Without a ramp the sine's start is taken
    // off, z_w = a (sin(wt + phi) - sin phi): the container starts from rest position, though not from rest.
    // The phase comes from the step count, so it does not drift. Before step 0 the walls are at rest.
    Pose at(std::int64_t step) const { return at(step, 0); }
    // Between two steps; `share` of one, from 0 to 1.
    Pose at(std::int64_t step, double share) const;

  private:
    double amplitude_ = 0, angular_frequency_ = 0, ramp_ = 0, start_phase_ = 0;
    Vec3 direction_{0, 0, 1};
    Clock clock_;
};

}  // namespace grainreel
