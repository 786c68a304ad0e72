// A film that is drawn in parts: which pictures each of them has.
#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct FilmPart {
    std::int64_t first_picture = 0, pictures = 0;  // of the film's
    std::int64_t first_frame = 0, frames = 0;      // likewise, with those that are held for captions
};

// Fewer pictures than these are no group of an encoder that codes them out of order.
constexpr std::int64_t least_pictures_of_part = 4;

// As even as they can be, and none of them empty. times: s, simulated, of the film's pictures; rising, and at
// least least_pictures_of_part times as many as parts.
std::vector<FilmPart> film_parts(const Film& film, const std::vector<double>& times, int parts);

// The picture that stands for the whole film, of those at these times. duration: s, of the run.
std::int64_t poster_picture(const Film& film, double duration, const std::vector<double>& times);

}  // namespace grainreel
