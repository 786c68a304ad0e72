// The point of a triangle that is nearest to a given point, and on which part of the triangle it lies. The
// step loop keeps such points, and needs no more of a surface for that.
#pragma once

#include <cstdint>

#include "engine/base/vector.hpp"

namespace grainreel {

// The part of a triangle that is nearest to a point: its face, one of its edges (edge e runs from corner e to
// corner e + 1), or a corner.
enum class Feature : std::uint8_t { face, edge0, edge1, edge2, corner0, corner1, corner2 };
struct NearestPoint {
    Vec3 at;         // m
    double squared;  // m2, squared distance from the given point
    Feature feature;
};

}  // namespace grainreel
