// Sizes of the bed that follow from the scene alone.
#pragma once

#include "engine/base/vector.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class Random;  // engine/base/random.hpp

double mean_cube(const SizeSpread& diameter);  // m3, the mean of d^3
double largest_diameter(const Scene& scene);   // m, the largest that a grain of any species may have
double smallest_diameter(const Scene& scene);  // m, the smallest; infinite without species
// Sums and means over all grains, including those that come during the run.
double solid_volume(const Scene& scene);   // m3
double mean_diameter(const Scene& scene);  // m
double total_mass(const Scene& scene);     // kg

// The species of the grains that are glued to walls. They count as infinitely heavy, like walls, so its
// density is infinite. Only for scenes with glued grains.
Species glued_species(const Scene& scene);
// The contact of grains of this species with glued grains. It is that of the two species, but its stiffness
// may differ.
PairContact glued_contact(const Scene& scene, std::size_t species);

// Height (m) above the container's base to which grains fill it at this solid fraction; at most up to its
// top.
double fill_height(const Scene& scene, double solid_fraction);

// The distance (m) between the walls that carry the bed sideways: the smaller of width and depth, or the
// width alone when the depth is periodic.
double bed_width(const Scene& scene);

// The box around the container, the places to which it turns, and its meshes; in empty space, the box around
// the grains, their flights and the meshes. Only the near part of a mesh counts: up to the container's size
// away from the container. In empty space a mesh counts whole, unless it is more than thirty times as large
// as the box of the grains; then its part within three times that box's size counts.
struct Extent {
    Vec3 low, high;  // m
    Vec3 size() const { return high - low; }
    Vec3 middle() const { return 0.5 * (low + high); }
    void take(const Vec3& point) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
    }
};
Extent extent_of(const Scene& scene);

// The tray below an outlet as a container. It is open above. Its floor lies below that of the scene's
// container at rest, by the tray's depth, and its rim lies where the container's floor is at its lowest. Only
// for scenes with a tray.
Container tray_container(const Scene& scene);

// Draws a diameter from a species' spread.

double draw_diameter(const SizeSpread& spread, Random& random);  // m

}  // namespace grainreel
