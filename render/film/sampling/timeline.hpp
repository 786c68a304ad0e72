// Moments that several scenes show in step, and the steps at which each of them does.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/frame.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct Instant {
    double time = 0;  // s, simulated
    int segment = 0;  // of the film
};

// The scene whose drive the film goes by: of the driven ones that with the longest period, so that no other
// has to show a moment twice; the first when none is driven.
std::size_t reference_of(const std::vector<FilmedScene>& scenes);

// The film's shots at the reference's steps; of the scene only the film counts.
std::vector<Instant> instants_of(const FilmedScene& film, const Clock& reference, std::int64_t steps);

// One shot an instant, from step 0 to `steps`: the step nearest in time, and in a locked segment the nearest
// of those at its phase of this scene's own drive. Two scenes of one frequency and phase so show one cycle.
std::vector<Shot> shots_at(const std::vector<Instant>& instants, const std::vector<FilmSegment>& segments,
                           const Clock& clock, std::int64_t steps);

// For a finished run that is drawn again, whose frames were not chosen for the film. The segment that a film
// of these frames is, one after the other at `rate` frames a second: locked when all phases agree and whole
// periods lie between, else in motion at the playback that follows from the interval. Its duration is the
// simulated time from the first to the last. None for fewer than two frames, or when they do not come evenly.
// It looks only at time, cycles and phase of the frames.
std::optional<FilmSegment> pacing_of(const std::vector<Frame>& moments, const Drive& drive, double rate);

// What the caption says of the time of these frames; where they do not come evenly, as it is on average.
// Empty for fewer than two.
std::string pacing_caption(const std::vector<Frame>& moments, const Drive& drive, double rate);

// What to say when frames are too few for the drive: it seems to move at another frequency. None when it does
// not, and for locked frames.
std::optional<std::string> pacing_warning(const std::vector<Frame>& moments, const Drive& drive);

}  // namespace grainreel
