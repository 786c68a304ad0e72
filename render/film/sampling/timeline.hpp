// Moments that several scenes show in step, and the steps at which each scene shows them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/state/state.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct Instant {
    double time = 0;         // s, simulated
    int segment = 0;         // the film's segment
    std::int64_t ahead = 0;  // steps_ahead() of a picture between two locked moments
};

// The index of the scene whose drive the film follows. It is the driven scene with the longest period, so
// that no other one has to show a moment twice; the first scene when none is driven.
std::size_t reference_of(const std::vector<FilmedScene>& scenes);

// The moments at which the film takes its shots, at the steps of the clock `reference`. Of the scene only the
// film is used.
std::vector<Instant> instants_of(const FilmedScene& film, const Clock& reference, std::int64_t steps);

// One shot for each instant, from step 0 to `steps`. It is the step nearest in time; in a locked segment it
// is the nearest step at the segment's phase of this scene's own drive. So two scenes with the same frequency
// and phase show the same cycle.
std::vector<Due> shots_at(const std::vector<Instant>& instants, const std::vector<FilmSegment>& segments,
                          const Clock& clock, std::int64_t steps);

// Finds the segment that frames of a finished run make when they are shown one after another at `rate` frames
// a second. The frames need not have been chosen for a film. It is locked if all phases agree and whole
// periods lie between the frames; otherwise it is in motion, at the playback that follows from their
// interval. Its duration is the simulated time from the first frame to the last. Returns none for fewer than
// two frames, or if they do not come evenly. Only time, cycles and phase of the frames are used.
std::optional<FilmSegment> pacing_of(const std::vector<State>& moments, const Drive& drive, double rate);

// What the caption says about the pace of these frames; if they do not come evenly, it gives the mean. Empty
// for fewer than two frames.
std::string pacing_caption(const std::vector<State>& moments, const Drive& drive, double rate,
                           const Wording& say = {});

// A warning for frames that are too few for the drive, which then seems to move at another frequency. None if
// there are enough frames, or if all are at one phase.
std::optional<std::string> pacing_warning(const std::vector<State>& moments, const Drive& drive);

}  // namespace grainreel
