// Convex polygons in space, cut by planes and made of triangles.
#pragma once

#include <vector>

#include "engine/base/vector.hpp"
#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

using Polygon = std::vector<Vec3>;  // corners in order, m

// A square on a plane: its middle is the place of the plane nearest to `near`.
Polygon square_on(const Vec3& point, const Vec3& normal, const Vec3& near, double half);
// What lies on the side that `normal` points to. Empty where nothing does.
Polygon cut(const Polygon& polygon, const Vec3& point, const Vec3& normal);
Polygon cut_to_box(Polygon polygon, const Vec3& low, const Vec3& high);

// Adds a convex polygon, cut into triangles from the corner that leaves the least slender ones.
void add_polygon(const Polygon& polygon, TriangleMesh& mesh);
// A vertical tube of `facets` about an axis, as large on average as a round one; rows of facets as high as
// wide about eight times.
void add_tube(const Vec3& axis, double radius, double low, double high, int facets, TriangleMesh& mesh);
// A level plate around a round hole, out to a rectangle.
void add_plate_with_hole(const Vec3& middle, double hole, const Vec3& low, const Vec3& high, int facets,
                         TriangleMesh& mesh);

// Degrees: more than all edges bend that are part of a smooth surface (up to 30).
double smooth_bend(const TriangleMesh& mesh);

}  // namespace grainreel
