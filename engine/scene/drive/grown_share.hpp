// How much of its amplitude a drive has while it grows.
#pragma once

#include "engine/base/numbers.hpp"
#include "engine/scene/drive/drive_schedule.hpp"

namespace grainreel {

// After so many periods: it grows over the ramp, and before 0 there is none. 1 from the first stage on.
inline double grown_share(const Drive& drive, double cycles) {
    if (cycles < 0) return 0;
    if (cycles >= drive.ramp || drive_now(drive, cycles).stage > 0) return 1;
    return smooth_step::value(cycles / drive.ramp);
}

}  // namespace grainreel
