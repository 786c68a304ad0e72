// Which steps become frames of the film.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// One frame of the film: taken at `step`, under the rule of segment `segment`.
struct Shot {
    std::int64_t step = 0;
    int segment = 0;
};

// What a frame's caption says of time: "slow motion 1/10" or "one frame a period, phase 0.25".
std::string playback_caption(const FilmSegment& segment, const Drive& drive, double film_rate);

// Shots in rising order of step, from step 0 to `steps`. Motion segments sample evenly in simulated time
// (rounded to the nearest step); locked ones take one step every `every` periods at `phase`.
std::vector<Shot> film_schedule(const Film& film, const Clock& clock, std::int64_t steps);

// One line for each segment that shows fewer than 8 frames a period without being locked, with the apparent
// frequency |f - k F|, F being frames per simulated second.
std::vector<std::string> strobe_warnings(const Film& film, const Drive& drive);

}  // namespace grainreel
