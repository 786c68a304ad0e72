// Turns a quantity's value into a colour: the colour maps, the scale that uses them, and the values that the
// colour bar needs. A new map needs an enumerator (render/scene/film.hpp), its word
// (render/scene/shown_values.hpp), and its colours and a case in colour_scale.cpp.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "engine/scene/text/units.hpp"
#include "render/scene/film.hpp"
#include "render/scene/filmed_scene.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {

// Counts the values that pictures have shown as colours, and those of them beyond either end of the colour
// bar.
struct ClippedCount {
    std::int64_t all = 0, below = 0, above = 0;
    void take(double value, const std::array<double, 2>& range) {
        if (std::isnan(value)) return;
        ++all;
        if (value < range[0]) ++below;
        if (value > range[1]) ++above;
    }
};

// "colours by speed: 0.4 % of the grains lie above 0.75 m/s"; empty where there is nothing to say. Where
// colours come in bands, the highest band has no upper end, so no value is said to lie above it. `of` names
// the things that are coloured, such as "grains".
std::string clipped_words(const GrainColouring& colouring, const ClippedCount& count, const char* of);

// The same for the triangles of meshes, but for values above the range alone: "walls by wear: ...".
std::string clipped_words(const FilmWalls& walls, const ClippedCount& count);

class ColourScale {
  public:
    explicit ColourScale(const GrainColouring& colouring, const Wording& wording = {});
    // For walls that are coloured by a quantity.
    explicit ColourScale(const FilmWalls& walls, const Wording& wording = {});

    // The sRGB colour of a value (SI). Beyond the range it is the colour of the nearer end.
    Colour at(double value) const { return at_share(share_of(value)); }
    // Where a value lies in the range: 0 at the low end, 1 at the high end.
    double share_of(double value) const;
    Colour at_share(double share) const;

    // The number of bands, each of one colour; 0 where colours change smoothly.
    int bands() const { return bands_; }
    bool logarithmic() const { return logarithmic_; }
    double low() const { return range_[0]; }  // SI
    double high() const { return range_[1]; }
    // Whether there can be values beyond an end. The colour at the end then also stands for them.
    bool open_below() const { return signed_ || low() > 0; }
    bool open_above() const { return true; }
    double unit_size() const { return unit_size_; }      // SI value of one unit as shown
    const std::string& title() const { return title_; }  // "speed (m/s)"

  private:
    ColourMap map_ = ColourMap::viridis;
    std::array<double, 2> range_;
    int bands_ = 0;
    bool signed_ = false, logarithmic_ = false;
    double unit_size_;
    std::string title_;
};

// A colour of a map, sRGB. share: 0 at the map's low end, 1 at its high end; beyond them the colour stays.
// All maps are safe for the colour-blind.
Colour colour_of(ColourMap map, double share);

}  // namespace grainreel
