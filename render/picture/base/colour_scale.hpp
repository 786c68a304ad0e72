// From a quantity's value to a colour, and the words and ticks that the colour bar needs.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/text/units.hpp"
#include "render/scene/film.hpp"
#include "render/scene/filmed_scene.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {

// How many values have had colours in pictures, and how many of them lie beyond an end of the bar.
struct ClippedCount {
    std::int64_t all = 0, below = 0, above = 0;
    void take(double value, const std::array<double, 2>& range) {
        if (std::isnan(value)) return;
        ++all;
        if (value < range[0]) ++below;
        if (value > range[1]) ++above;
    }
};

// "colours by speed: 0.4 % of the grains lie above 0.75 m/s"; empty where none does. of: "grains".
std::string clipped_words(const GrainColouring& colouring, const ClippedCount& count, const char* of);

// Likewise of meshes: "walls by wear: ...".
std::string clipped_words(const FilmWalls& walls, const ClippedCount& count);

class ColourScale {
  public:
    explicit ColourScale(const GrainColouring& colouring);
    explicit ColourScale(const FilmWalls& walls);  // whose colour is not plain

    // sRGB; value: SI. Held at the ends beyond the range.
    Colour at(double value) const { return at_share(share_of(value)); }
    // Where in the range it is, 0 to 1 between the ends.
    double share_of(double value) const;
    // The same by where in the range it is, 0 to 1.
    Colour at_share(double share) const;

    // How many bands of one colour each; 0: colours change smoothly.
    int bands() const { return bands_; }
    bool logarithmic() const { return logarithmic_; }
    double low() const { return range_[0]; }  // SI
    double high() const { return range_[1]; }
    // Whether there can be values beyond an end, which then stands for all of these.
    bool open_below() const { return signed_ || low() > 0; }
    bool open_above() const { return true; }
    double unit_size() const { return unit_size_; }      // SI in one of the unit shown
    const std::string& title() const { return title_; }  // "speed (m/s)"

  private:
    ColourMap map_ = ColourMap::viridis;
    std::array<double, 2> range_;
    int bands_ = 0;
    bool signed_ = false, logarithmic_ = false;
    double unit_size_;
    std::string title_;
};

// Colour maps for numbers, safe for the colour-blind.

// sRGB; share: 0 at the map's low end, 1 at its high end, held beyond.
Colour colour_of(ColourMap map, double share);

}  // namespace grainreel
