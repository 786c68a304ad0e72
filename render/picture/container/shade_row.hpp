// Darkens a row of pixels by what a map says of the places that they show. The loop is compiled for each
// instruction set.
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace grainreel {

struct ShadeMap {
    const float* cells;  // strengths of 0 to 255, rows of `side` numbers; those on the rim are 0
    int side;
};

// (u, v, w) of the first pixel, and its step from each pixel to the next. u/w, v/w is the place on the map,
// in cells from the middle of the first one. Places beside the map are not darkened.
struct MapWalk {
    Eigen::Vector3f first, step;
};

// pixels[i] = over(black of strength map * across[i] * all, pixels[i]). Between cells strengths are
// interpolated along both axes.
void shade_row(const ShadeMap& map, const MapWalk& walk, const float* across, float all,
               std::uint32_t* pixels, int count);

}  // namespace grainreel
