// Moments that several scenes show in step, and the steps at which each of them does.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/clock.hpp"
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

}  // namespace grainreel
