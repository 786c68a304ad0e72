// DriveMotion is the motion of the drive: its ramp, its sine, its stages and its taps, as a pose at each
// step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/base/vector.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "engine/state/body.hpp"

namespace grainreel {

// DriveMotion gives the pose of the drive at each step.
class DriveMotion {
  public:
    DriveMotion() = default;  // at rest for ever
    DriveMotion(const Drive& drive, const Clock& clock);

    bool moving() const { return moving_; }

    // z_w = a s(t) sin(wt + phi), v_w = a (s w cos(wt + phi) + s' sin(wt + phi)), where s rises from 0 to 1
    // over the ramp as 10u^3 - 15u^4 + 6u^5 (twice differentiable), and u is the share of the ramp that has
    // passed. z_w is the displacement along the drive's direction. Without a ramp, the sine's value at the
    // start is subtracted, z_w = a (sin(wt + phi) - sin phi): the container starts in its place at rest,
    // though not from rest. The phase comes from the step count, so it does not drift. Before step 0 nothing
    // moves.
    DrivePose at(std::int64_t step) const { return at(step, 0); }
    // The pose between two steps; `share` is the share of the step that has passed, from 0 to 1. For a drive
    // with stages (engine/scene/drive_schedule.hpp), z_w = a sin p, or a (sin p - sin phi) without a ramp.
    // The phase p has no jump between stages, and a and w are constant or change as that file says. With t
    // from the start of a tap, the tap is z_w = a (1 - cos wt): the walls go up and down once, from rest to
    // rest.
    DrivePose at(std::int64_t step, double share) const;

  private:
    struct Motion {
        double offset = 0, velocity = 0;  // m, m/s
    };
    Motion before_stages(std::int64_t step, double share) const;
    Motion in_stretch(std::size_t index, std::int64_t step, double share) const;
    static Motion tap(const DriveSchedule::Piece& piece, double since);  // `since`: s since the tap began
    std::size_t stretch_at(std::int64_t step) const;

    bool moving_ = false;
    double amplitude_ = 0, angular_frequency_ = 0, ramp_ = 0, start_phase_ = 0, start_sine_ = 0;
    std::vector<DriveSchedule::Piece>
        pieces_;  // what the drive does in each stretch of clock_.changes; empty for a drive without stages
    Vec3 direction_{0, 0, 1};
    Clock clock_;
};

}  // namespace grainreel
