// How far grains fall, and how high they lie, before anything has been computed. Heights are along the
// direction against gravity (z without gravity), from the scene's origin.
#pragma once

#include "engine/scene/scene.hpp"

namespace grainreel {

constexpr double settled_solid_fraction = 0.6;

// m: depth of the settled bed. In empty space with meshes it is that of a region's section, or of a cube.
double bed_depth(const Scene& scene);

// m: height of the lowest wall to fall on. The container's base is one, and so is a mesh that lies lower.
// Without meshes it is 0.
double lowest_wall(const Scene& scene);

// m: height of the highest or lowest corner of a box.
double highest_corner(const Scene& scene, const Vec3& low, const Vec3& high);
double lowest_corner(const Scene& scene, const Vec3& low, const Vec3& high);

// m: how far the highest grain falls at the start, upon a bed of this depth (m). From a region, and in empty
// space with meshes, it falls to the lowest wall.
double start_drop(const Scene& scene, double depth);

// m: how far grains fall from the container, or from the region they start in, to a mesh further below.
double drop_below(const Scene& scene);

// Rain: where above the bed its grains appear, and how many a second.

// Heights of centres over the bed's surface; m. They appear between the two.
struct RainLayer {
    double low = 0, high = 0;
};
RainLayer rain_layer(const Scene& scene);

// m: the deepest fall of a grain of the rain.
double rain_drop(const Scene& scene);

// 1/s: as the scene says, or as many as fill a twentieth of the layer that they fall through.
double rain_rate(const Scene& scene);

// s: how long the next grain may find no place before there is none, five times a fall through the layer.
double rain_patience(const Scene& scene);
// s: twice as long as it rains where every grain finds its place at once, and that patience.
double rain_limit(const Scene& scene);

}  // namespace grainreel
