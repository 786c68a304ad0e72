// The shapes of types in GSD (gsd.readthedocs.io, "Shape Visualization"): a text in JSON for each type.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

struct GsdShape {
    std::string name;          // "Sphere"; empty where nothing is said
    std::optional<Vec3> half;  // half lengths of a sphere or an ellipsoid, in the file's unit

    bool is_sphere() const;
    bool is_ellipsoid() const { return half && !is_sphere(); }
};

// {"type": "Sphere", "diameter": 2}, {"type": "Ellipsoid", "a": 1, "b": 2, "c": 3} and others.
GsdShape gsd_shape(const std::string& text);

// Whether some types are ellipsoids, and all others have a size: their own, or that of their grains.
bool draws_ellipsoids(const std::vector<GsdShape>& shapes, bool grains_have_diameters);

// Adds the half lengths of each grain as columns, and how it is turned where the file does not say. Grains of
// other shapes are spheres of their own diameter.
void add_half_lengths(RawTable& grains, const std::vector<GsdShape>& shapes);

// Adds the diameter of each grain, where a type that is a sphere says it; NaN for others.
void add_diameters(RawTable& grains, const std::vector<GsdShape>& shapes);

}  // namespace grainreel
