// The surface of a bed across its container: h(y), the height of the topmost grains.
#pragma once

#include <span>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

// Heights of the surface at the middles of equal bins of y.
struct BedOutline {
    double left = 0, bin = 0;    // m: where the first bin begins, and how wide each is
    std::vector<double> height;  // m, in the room

    double width() const { return bin * static_cast<double>(height.size()); }  // m
    double place(std::size_t i) const { return left + bin * (static_cast<double>(i) + 0.5); }
    double mean() const;
};

// What the bed stands in: y from left to right, x from back to front, m; and how large its grains are.
struct SurfaceFrame {
    double left = 0, right = 0, back = 0, front = 0;
    double period = 0;    // m, of x; 0 for none
    double diameter = 0;  // m: bins are about two of it wide
};

std::size_t bins_across(const SurfaceFrame& frame);

// In each column of bed two diameters wide and deep, grains are stacked from the lowest one up; the bed ends
// where the next grain leaves a gap of more than a diameter and a half, so grains in flight have no say. The
// top of the highest grain below that is the surface there, and h is its mean over the depth. A grain stands
// in the column that holds its centre, and with its longest chord there in every other column that it reaches
// into. Columns that no grain reaches up to their middle have no say: they are beside the bed. A bin without
// others takes the mean of the nearest ones. Empty without grains.
BedOutline surface_of(std::span<const Place> grains, const SurfaceFrame& frame);

// Where the surface of a scene's bed is looked for.

// The frame of the container at rest, as wide as it is free at the height that the grains fill. Bins go by
// the mean diameter of all grains. It has no width in empty space, nor in a drum (drum_surface.hpp).
SurfaceFrame surface_frame(const Scene& scene);

// How far a surface is heaped up.

struct Mound {
    double height = 0;  // m: mean of the middle third less that of the two outer sixths
    double slope = 0;   // tangent: mean rise of both halves towards the middle
    double tilt = 0;    // tangent: rise of the whole surface from left to right
};

// Slopes are those of least-squares lines through the bins. A tent of slope s over the width W has s, no
// tilt, and the height s W / 3; a plane has no slope. NaN with fewer than six bins.
Mound mound_of(const BedOutline& surface);

}  // namespace grainreel
