// Which part of the picture is whose: gutters for words, the rest for the container; and how large letters
// are.
#pragma once

#include <string>
#include <vector>

#include "render/picture/base/rectangle.hpp"
#include "render/scene/film.hpp"

namespace grainreel {

// Sizes of letters and gaps, pixels.
struct TypeScale {
    double main, minor, title, gap, margin;
};
// Main text at least 2.5 % and minor text 1.8 % of the picture's height; both times `shrink`, but never below
// 10 pixels.
TypeScale type_scale(const Film& film, double shrink = 1);

struct PictureLayout {
    bool stacked = false;               // gutters above and below instead of left and right
    TypeScale type{};                   // of the words
    Rectangle first;                    // left or top: title, legend, scale
    Rectangle second;                   // right or bottom: time, drive, playback
    Rectangle port;                     // the container
    bool plates = false;                // the port is the whole picture, and words lie over it
    std::vector<std::string> left_out;  // words that there is no room for
};
// The container has the whole picture, and there are no words.
PictureLayout bare_layout(const Film& film);

}  // namespace grainreel
