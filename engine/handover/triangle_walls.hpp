// Walls as triangles, for LIGGGHTS: planes, cylinders and plates of the container, and the scene's meshes.
//
// Each face is a mesh of its own. So no two share an edge, and a grain in a corner touches both, as with us.
// A plane goes to the sides of the box that the run is in: few fat triangles. Grains touch triangles from
// both sides.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/handover/carried_scene.hpp"
#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

struct TriangleWall {
    std::string id;           // in the deck: "face0", "mesh2"
    std::string file;         // "walls/face0.stl"
    std::size_t surface = 0;  // of CarriedScene::surfaces
    TriangleMesh shape;       // at rest, m, in the run's frame
    double curvature = 1e-5;  // degrees: edges that bend less are none

    // How it moves, all at once; in the container's frame what goes with the container stands still.
    bool driven = false;
    Vec3 velocity{0, 0, 0};                // m/s
    std::string rate;                      // rad/s, an expression of v_t; empty: it does not turn
    Vec3 axis{0, 0, 1}, through{0, 0, 0};  // of the turn; unit, m
};

// Those of the time before an outlet opens, or of the time after. Throws UserError where a wall would leave
// the box on its way.
std::vector<TriangleWall> triangle_walls(const CarriedScene& carried, bool opened);

// m: the lowest place at which a grain counts as gone, a mesh across the box. Empty without an outlet, and
// with a tray.
TriangleMesh exit_plane(const CarriedScene& carried);

// The box (low, high) becomes large enough for meshes on their ways. Before data and deck are written.
void make_room_for_walls(CarriedScene& carried);

// All of them as STL below the folder. Throws RunError.
void write_triangle_walls(const std::filesystem::path& folder, const CarriedScene& carried);

// Convex polygons in space, cut by planes and made of triangles.

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
