// The solid fraction of a bed between heights, in closed form: parts of spheres over the room in the
// container.
#pragma once

#include <vector>

#include "engine/questions/snapshot.hpp"

namespace grainreel {

// m3, of a sphere about height 0 with this radius: the part below `height`. pi r^3 (2 + 3 t - t^3) / 3 with
// t = height / r (a spherical segment; Bronshtein and Semendyayev, 3.3.4.6).
double sphere_below(double radius, double height);

// Divides the bed from `low` up (m, in the container's frame) into `count` slices of equal height. Returns
// the volume of the grains there over the room inside the container. NaN where there is no room: below its
// floor, above its rim, in empty space. Grains that are glued to walls do not count.
std::vector<double> solid_fractions(const Snapshot& snapshot, double low, double height, std::size_t count);

}  // namespace grainreel
