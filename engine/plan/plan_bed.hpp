// How far grains fall and how high they lie, before anything has been computed; and where the grains of rain
// appear. Heights are measured from the scene's origin, in the direction opposite to gravity (z without
// gravity).
#pragma once

#include "engine/scene/scene.hpp"

namespace grainreel {

constexpr double settled_solid_fraction = 0.6;

// Depth (m) of the settled bed. In empty space with meshes the grains are taken to fill the start region's
// section or, without a region, a cube.
double bed_depth(const Scene& scene);

// Height (m) of the lowest wall that grains can fall on: the container's base, or a mesh that lies lower.
// Without meshes it is 0.
double lowest_wall(const Scene& scene);

// Height (m) of the highest and of the lowest corner of a box.
double highest_corner(const Scene& scene, const Vec3& low, const Vec3& high);
double lowest_corner(const Scene& scene, const Vec3& low, const Vec3& high);

// How far (m) the highest grain falls at the start: onto a bed of this depth (m) or, from a start region, to
// the lowest wall. 0 in empty space with meshes, where all grains are fed.
double start_drop(const Scene& scene, double depth);

// How far (m) grains fall from the container, or from their start region, to a mesh further below.
double drop_below(const Scene& scene);

// The layer in which grains appear: lowest and highest height (m) of their centres above the bed's surface.
struct RainLayer {
    double low = 0, high = 0;
};
RainLayer rain_layer(const Scene& scene);

// The deepest fall (m) of a grain of the rain.
double rain_drop(const Scene& scene);

// Grains per second: as the scene says, or so many that they fill a twentieth of the layer that they fall
// through.
double rain_rate(const Scene& scene);

// How long (s) a grain may find no place before rain gives up: five times a fall from the layer's top to the
// bed.
double rain_patience(const Scene& scene);
// The limit of rain (s): twice the time that it needs if every grain finds its place at once, plus
// rain_patience().
double rain_limit(const Scene& scene);

}  // namespace grainreel
