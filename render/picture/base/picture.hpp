// A picture, 8-bit sRGB pixels in rows from the top; how its space is shared between words and the container;
// and the colours of everything in it that is not a grain. Films include this header: keep it light.
#pragma once

#include <algorithm>
#include <cmath>
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
    // The number of the part that stands still: pictures with the same number have the same rectangles
    // `moving`, and outside these the same pixels. 0: nothing is known.
    std::uint64_t still = 0;
    std::vector<Rectangle> moving;

    Picture() = default;
    Picture(int w, int h) : width(w), height(h), rgba(static_cast<std::size_t>(w) * h * 4) {}
    std::uint8_t* pixel(int x, int y) { return rgba.data() + (static_cast<std::size_t>(y) * width + x) * 4; }
    const std::uint8_t* pixel(int x, int y) const {
        return rgba.data() + (static_cast<std::size_t>(y) * width + x) * 4;
    }
};

// Copies a part of a picture into another one of the same size.
void copy_part(const Picture& from, const Rectangle& part, Picture& to);

// Divides colours by alpha. The layers of a picture have colours multiplied by alpha; pictures have plain
// ones.
void divide_by_alpha(Picture& picture, const Rectangle& port);

// Sizes of letters and gaps, pixels.
struct TypeScale {
    double main, minor, title, gap, margin;
};
// Main text is 2.8 % and minor text 2.25 % of the picture's height, less in narrow pictures. Both are
// multiplied by `shrink`, but digits stay 11 pixels high where the picture is 480 pixels wide and high or
// larger. In smaller pictures they shrink with it, to letters of 10 pixels.
TypeScale type_scale(const Film& film, double shrink = 1);
// Pixels: the least size of letters.
double least_letters(const Film& film);

// Which parts of the picture are gutters for words, and which part shows the container.
struct PictureLayout {
    bool stacked = false;  // the second gutter is rows below the container instead of a column
    bool one_row = false;  // both gutters lie beside each other in one row, above or below the container
    TypeScale type{};      // sizes of the words
    Rectangle first;       // title, legend, scale; in rows if it is as wide as the picture, else in a column
    Rectangle second;      // time, drive, playback, plots
    Rectangle port;        // the container
    Rectangle caption;     // the band below all of them, for film.caption; empty without captions
    bool plates = false;   // the port is the whole picture, and words lie over it
    std::vector<std::string> left_out;  // words that there is no room for
};
// The layout in which the container has the whole picture and there are no words.
PictureLayout bare_layout(const Film& film);

inline Colour mix(const Colour& a, const Colour& b, double share_of_b) {
    const auto blend = [&](double x, double y) { return x + (y - x) * share_of_b; };
    return {blend(a.red, b.red), blend(a.green, b.green), blend(a.blue, b.blue)};
}

// From sRGB (IEC 61966-2-1) to linear light and back, 0 to 1.
inline double to_linear(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}
inline double to_srgb(double linear) {
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

// Rounds to 8-bit steps, so that Cairo and OpenGL, which round differently, write the same bytes.
inline Colour in_bytes(const Colour& colour) {
    const auto step = [](double value) { return std::round(255 * value) / 255; };
    return {step(colour.red), step(colour.green), step(colour.blue)};
}

// Relative luminance, 0 to 1, and contrast, 1 to 21, as WCAG 2.2 defines them.
inline double luminance(const Colour& c) {
    return 0.2126 * to_linear(c.red) + 0.7152 * to_linear(c.green) + 0.0722 * to_linear(c.blue);
}
inline double contrast(const Colour& a, const Colour& b) {
    const double x = luminance(a) + 0.05, y = luminance(b) + 0.05;
    return x > y ? x / y : y / x;
}

// The colours of everything that is not a grain. They are computed from the background, so that they can be
// read on light and on dark ones.
struct Palette {
    Colour background, ink, faint_ink, solid, accent;
    Colour force;       // lines between grains, and arrows at one grain
    Colour wall_force;  // arrows at walls
};

// A ground is a little of the walls' colour on the background; at most this share.
constexpr double kMostGround = 0.17, kMostGroundInTheDark = 0.29;

// ground: whether words may also stand on the ground.
inline Palette make_palette(const Colour& background, bool ground = false) {
    const bool light = luminance(background) > 0.18;  // then dark ink has more contrast than light ink
    Palette palette;
    palette.background = in_bytes(background);
    palette.ink = light ? Colour{0.11, 0.13, 0.16} : Colour{0.94, 0.95, 0.97};
    palette.solid = mix(background, light ? Colour{0.36, 0.42, 0.50} : Colour{0.70, 0.76, 0.84}, 0.62);
    // Ink as faint as can still be read. On middle tones it is hardly fainter.
    const double most = ground ? (light ? kMostGround : kMostGroundInTheDark) : 0;
    const Colour below = mix(background, palette.solid, most);
    double faint = light ? 0.28 : 0.22;
    while (faint > 0 && contrast(mix(palette.ink, background, faint), below) < 4.5) faint -= 0.02;
    palette.faint_ink = mix(palette.ink, background, std::max(0.0, faint));
    palette.force = light ? Colour{0.40, 0.18, 0.55} : Colour{0.78, 0.62, 1.0};
    palette.wall_force = light ? Colour{0.0, 0.38, 0.36} : Colour{0.36, 0.86, 0.76};
    palette.accent = light ? Colour{0.72, 0.16, 0.10} : Colour{1.0, 0.55, 0.42};
    return palette;
}

// In a film without a background no words are faint: grey words on a halo may be lost on what lies below.
inline Palette palette_of(const Film& film) {
    Palette palette = make_palette(film.background, film.look.ground && !film.transparent);
    if (film.transparent) palette.faint_ink = palette.ink;
    return palette;
}

// The least alpha of a plate of the background's colour at which all words on it have a contrast of 4.6 (and
// a little more, for rounding), whatever is under the plate; 1 when no lower alpha is enough.
inline double plate_strength(const Palette& palette) {
    for (double strength = 0.7; strength < 1; strength += 0.01) {
        bool reads = true;
        for (const Colour& under : {Colour{0, 0, 0}, Colour{1, 1, 1}})
            for (const Colour& ink : {palette.ink, palette.faint_ink, palette.accent})
                reads = reads && contrast(ink, mix(under, palette.background, strength)) >= 4.6;
        if (reads) return strength;
    }
    return 1;
}

}  // namespace grainreel
