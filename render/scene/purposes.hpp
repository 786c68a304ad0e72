// The purposes that films are made for, and the defaults that suit each of them. docs/guide/films.md has the
// same table with its reasons.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/scene/film.hpp"

namespace grainreel {

struct Purpose {
    const char* name;
    int width, height;  // pixels
    double rate;        // frames a second
    FilmFormat format;
    int quality;  // the value of film.quality
    const char* preset;
    std::optional<std::int64_t> max_size;  // bytes
    std::array<int, 2> sheet;              // zeros: none
};

const std::vector<Purpose>& purposes();
std::vector<std::string> purpose_names();

// The defaults of a purpose as assignments to keys, for a scene that has values for all of them.
std::vector<std::string> assignments_of(const Purpose& purpose);

// Null when there is no purpose of that name.
const Purpose* find_purpose(const std::string& name);

}  // namespace grainreel
