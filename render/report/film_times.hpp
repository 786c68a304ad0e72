// Which moment of the run each frame of its film shows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/scene.hpp"

namespace grainreel {

struct FilmTimes {
    std::vector<double> times;  // s, one a frame; empty where they are not known
    std::string why_not;        // then: a sentence for the page
};

// Made from the scene as the run made it. frames: of the film, as run.json has them. first: s, where the run
// began. Known only where the number of frames agrees: a film may leave out locked frames of a bed that
// repeats itself every other period, as the run finds out. whole: the run was complete.
FilmTimes film_times(const Scene& scene, std::int64_t frames, double first, bool whole);

}  // namespace grainreel
