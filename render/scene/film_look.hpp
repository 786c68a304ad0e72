// How the pictures of the film are lit, and where the bed is opened.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

// A plane that opens the bed: grains are kept on the side that its normal points away from, those that it
// crosses show a flat face. It goes with the container.
struct FilmCut {
    bool present = false;
    Vec3 normal{1, 0, 0};  // unit, towards what is taken away
    double at = 0;         // m, of the plane from the origin, along the normal
    double thickness = 0;  // m, of the slab that is kept; 0: all behind the plane
    bool operator==(const FilmCut&) const = default;
};

// How meshes are drawn.
struct FilmWalls {
    // plain: as walls are; else by what the grains do to each triangle: how hard they press on it, or how
    // they wear it.
    enum class Colour { plain, pressure, wear };
    Colour colour = Colour::plain;
    // Range of the colours for the whole film, in Pa or J/m2. It has no meaning where walls are plain.
    std::array<double, 2> range{0, 0};
    bool fixed = false;              // the range is the user's
    double edge_angle = 30;          // degrees; edges whose faces turn more are drawn
    std::vector<std::string> solid;  // names of meshes that are solid from all sides
    std::vector<std::string> glass;  // names of meshes that are glass from outside
    bool coloured() const { return colour != Colour::plain; }
    // Steps of the colour are ratios; else, where the range begins at 0, differences.
    bool logarithmic() const { return range[0] > 0; }
    bool operator==(const FilmWalls&) const = default;
};

struct FilmLook {
    enum class Style { studio, flat, dark };
    Style style = Style::studio;
    bool occlusion = true;  // darkness between grains
    bool shadows = true;    // of grains on grains
    bool ground = true;     // a ground that the container throws its shadow on
    bool rotation = false;  // two-tone grains that show how they turn; needs orientations
    FilmCut cut;
    FilmWalls walls;
    bool operator==(const FilmLook&) const = default;

    // What a style means where nothing else is said.
    static FilmLook of(Style style) {
        const bool lit = style != Style::flat;
        return {style, lit, lit, lit, false, {}, {}};
    }
};

}  // namespace grainreel
