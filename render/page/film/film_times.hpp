// Which moment of the run each frame of its film shows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct FilmTimes {
    std::vector<double> times;  // s, one a frame; empty where they are not known
    std::string why_not;        // then: a sentence for the page
};

// As the run's own table has them (film_times.csv), where it agrees with the number of frames and its times
// rise.
std::optional<FilmTimes> kept_film_times(const std::filesystem::path& folder, std::int64_t frames);

// Without it: made from the scene as the run made it. frames: of the film, as run.json has them. first: s,
// where the run began. Known only where the number of frames agrees: a film may leave out locked frames of a
// bed that repeats itself every other period, as the run finds out. whole: the run was complete.
FilmTimes film_times(const FilmedScene& scene, std::int64_t frames, double first, bool whole);

}  // namespace grainreel
