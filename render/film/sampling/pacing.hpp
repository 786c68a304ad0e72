// How a film plays whose frames were kept at given moments and not chosen for it: a finished run drawn again.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/frame.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The segment that a film of these frames is, one after the other at `rate` frames a second: locked when all
// phases agree and whole periods lie between, else in motion at the playback that follows from the interval.
// Its duration is the simulated time from the first to the last. None for fewer than two frames, or when they
// do not come evenly. Of the frames only time, cycles and phase are looked at.
std::optional<FilmSegment> pacing_of(const std::vector<Frame>& moments, const Drive& drive, double rate);

// What the caption says of the time of these frames; where they do not come evenly, as it is on average.
// Empty for fewer than two.
std::string pacing_caption(const std::vector<Frame>& moments, const Drive& drive, double rate);

// What to say when frames are too few for the drive: it seems to move at another frequency. None when it does
// not, and for locked frames.
std::optional<std::string> pacing_warning(const std::vector<Frame>& moments, const Drive& drive);

}  // namespace grainreel
