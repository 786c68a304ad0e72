// Sizes of the bed that follow from the scene alone.
#pragma once

#include "engine/base/random.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

double mean_cube(const SizeSpread& diameter);  // m3, the mean of d^3
double largest_diameter(const Scene& scene);   // m, that a grain of any species may have
// Sums over all grains, those that come during the run among them.
double solid_volume(const Scene& scene);   // m3
double mean_diameter(const Scene& scene);  // m
double total_mass(const Scene& scene);     // kg

// The species of the grains that are glued to walls, as heavy as these: of infinite density. Only where there
// are some.
Species glued_species(const Scene& scene);
// The contact of grains of this species with these: that of the two species, but for a stiffness of its own.
PairContact glued_contact(const Scene& scene, std::size_t species);

// m, how high the container is filled above its base when the grains lie at this solid fraction; up to its
// top at most.
double fill_height(const Scene& scene, double solid_fraction);

// m, what carries the bed sideways: the smaller of width and depth, the width alone when the depth is
// periodic.
double bed_width(const Scene& scene);

// The box that the container takes up, or in empty space the grains and their way, and meshes where they
// move. Of meshes that reach far beyond only what is near: within the size of the container, or, where they
// are more than thirty times as large as all that happens to the grains, within three times that.
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

// The tray below an outlet as a container, open above, whose floor lies that deep below that of the scene's
// container at rest. Only where there is one. It ends where the container's floor comes at its lowest.
Container tray_container(const Scene& scene);

// Diameters drawn from a species' spread.

double draw_diameter(const SizeSpread& spread, Random& random);  // m

}  // namespace grainreel
