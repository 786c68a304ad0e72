// The drive: displacement from rest and velocity of the moving faces at a given step.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

class WallMotion {
  public:
    WallMotion() = default;  // at rest for ever
    WallMotion(const Drive& drive, const Clock& clock);

    bool moving() const { return moving_; }

    // z_w = a s(t) sin(wt + phi), v_w = a (s w cos(wt + phi) + s' sin(wt + phi)), where s rises from 0 to 1
    // over the ramp as 10u^3 - 15u^4 + 6u^5 (twice differentiable). Without a ramp the sine's start is taken
    // off, z_w = a (sin(wt + phi) - sin phi): the container starts from rest position, though not from rest.
    // The phase comes from the step count, so it does not drift. Before step 0 the walls are at rest.
    Pose at(std::int64_t step) const { return at(step, 0); }
    // The pose between two steps; `share` is the share of the step that has passed, from 0 to 1.
    // In a stage z_w = a (sin(p) - sin phi), the last term without a ramp only, where the phase p goes on
    // from before and a and f are constant, or change as in engine/scene/drive_schedule.hpp. A tap is z_w
    // = a (1 - cos wt), once up and down from rest to rest.
    Pose at(std::int64_t step, double share) const;

  private:
    struct Motion {
        double offset = 0, velocity = 0;  // m, m/s
    };
    Motion before_stages(std::int64_t step, double share) const;
    Motion in_stretch(std::size_t index, std::int64_t step, double share) const;
    static Motion tap(const DriveSchedule::Piece& piece, double since);  // `since`: s since the tap began
    std::size_t stretch_at(std::int64_t step) const;

    bool moving_ = false;
    double amplitude_ = 0, angular_frequency_ = 0, ramp_ = 0, start_phase_ = 0;
    std::vector<DriveSchedule::Piece> pieces_;  // parallel to the clock's changes; empty for one stage
    Vec3 direction_{0, 0, 1};
    Clock clock_;
};

}  // namespace grainreel
