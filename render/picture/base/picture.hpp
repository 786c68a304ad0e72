// A picture, 8-bit sRGB pixels in rows from the top, and how its space is shared between words and the
// container. Films include this header: keep it light.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/scene/film.hpp"

namespace grainreel {

// Pixels, counted from the top left corner of the whole picture.
struct Rectangle {
    int x = 0, y = 0, width = 0, height = 0;
};

struct Picture {
    int width = 0, height = 0;
    // width * height * 4 bytes without padding. Colours are not multiplied by alpha, which is 255 except in
    // films with a transparent background.
    std::vector<std::uint8_t> rgba;
    // Pictures with the same number have the same `moving`, and outside of it the same pixels. 0: nothing is
    // known.
    std::uint64_t still = 0;
    std::vector<Rectangle> moving;

    Picture() = default;
    Picture(int w, int h) : width(w), height(h), rgba(static_cast<std::size_t>(w) * h * 4) {}
    std::uint8_t* pixel(int x, int y) { return rgba.data() + (static_cast<std::size_t>(y) * width + x) * 4; }
    const std::uint8_t* pixel(int x, int y) const {
        return rgba.data() + (static_cast<std::size_t>(y) * width + x) * 4;
    }
};

// Makes plain colours, as pictures have them, of colours multiplied by alpha, as layers have them.
void divide_by_alpha(Picture& picture, const Rectangle& port);

// Sizes of letters and gaps, pixels.
struct TypeScale {
    double main, minor, title, gap, margin;
};
// Main text is at least 2.5 % and minor text 1.8 % of the picture's height. Both are multiplied by `shrink`,
// but stay at least 10 pixels.
TypeScale type_scale(const Film& film, double shrink = 1);

// Which parts of the picture are gutters for words, and which part shows the container.
struct PictureLayout {
    bool stacked = false;               // gutters above and below instead of left and right
    TypeScale type{};                   // sizes of the words
    Rectangle first;                    // left or top: title, legend, scale
    Rectangle second;                   // right or bottom: time, drive, playback
    Rectangle port;                     // the container
    bool plates = false;                // the port is the whole picture, and words lie over it
    std::vector<std::string> left_out;  // words that there is no room for
};
// The layout in which the container has the whole picture and there are no words.
PictureLayout bare_layout(const Film& film);

}  // namespace grainreel
