// The clock that goes with a drive: how many steps its periods have, throughout all stages.
#pragma once

#include "engine/base/clock.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// The eighth of a period of the drive's own frequency in steps, `least` or somewhat more: the first with
// which the periods of all stages have multiples of 8 steps too, and intervals between taps whole steps.
// `least` where there is no such number within a few per cent; then phases lie between steps in some stages.
double common_eighths(const Drive& drive, double least);

// step: s. steps_per_period: of the drive's own frequency.
Clock drive_clock(const Drive& drive, double step, std::int64_t steps_per_period);

}  // namespace grainreel
