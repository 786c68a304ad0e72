// Makes walls of triangles for LIGGGHTS: planes, cylinders and plates of the container, and the scene's
// meshes. wall_polygons.cpp has the shapes that they are made of.
//
// Each face is a mesh of its own. So no two faces share an edge, and a grain in a corner touches both, as in
// our engine. A plane extends to the sides of the run's box, with a few wide triangles. Grains touch
// triangles from both sides.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/triangle_mesh.hpp"
#include "engine/base/vector.hpp"
#include "engine/handover/carried_scene.hpp"

namespace grainreel {

struct TriangleWall {
    std::string id;           // its name in the deck: "face0", "mesh2"
    std::string file;         // "walls/face0.stl"
    std::size_t surface = 0;  // index in CarriedScene::surfaces
    TriangleMesh shape;       // at rest, m, in the run's frame
    double curvature = 1e-5;  // degrees; where two triangles meet at a smaller angle there is no edge

    // Its motions, which add up. In the container's frame walls that move with the container stand still.
    bool driven = false;
    Vec3 velocity{0, 0, 0};                // m/s
    std::string rate;                      // rad/s, an expression of v_t; empty if it does not turn
    Vec3 axis{0, 0, 1}, through{0, 0, 0};  // unit vector, and a point of the axis (m)
};

// The walls before an outlet opens, or after that. Throws UserError where a wall would leave the box while it
// moves.
std::vector<TriangleWall> triangle_walls(const CarriedScene& carried, bool opened);

// A mesh across the box. A grain below it counts as gone. Empty without an outlet and with a tray.
TriangleMesh exit_plane(const CarriedScene& carried);

// Makes the box (low, high) large enough for meshes as they move. Called before data and deck are written.
void make_room_for_walls(CarriedScene& carried);

// Writes all walls as STL into the folder. Throws RunError.
void write_triangle_walls(const std::filesystem::path& folder, const CarriedScene& carried);

// A convex polygon in space by its corners in order, m.
using Polygon = std::vector<Vec3>;

// A square on a plane. Its middle is the point of the plane nearest to `near`.
Polygon square_on(const Vec3& point, const Vec3& normal, const Vec3& near, double half);
// The part of a polygon on the side that `normal` points to; empty where there is none.
Polygon cut(const Polygon& polygon, const Vec3& point, const Vec3& normal);
Polygon cut_to_box(Polygon polygon, const Vec3& low, const Vec3& high);

// Adds a convex polygon. It is cut into triangles from that corner which gives the least slender ones.
void add_polygon(const Polygon& polygon, TriangleMesh& mesh);
// Adds a vertical tube of so many flat facets. `radius` is the mean distance of its surface from the axis. A
// facet is at most about eight times as high as wide.
void add_tube(const Vec3& axis, double radius, double low, double high, int facets, TriangleMesh& mesh);
// A level plate from a round hole out to a rectangle.
void add_plate_with_hole(const Vec3& middle, double hole, const Vec3& low, const Vec3& high, int facets,
                         TriangleMesh& mesh);

// The largest angle (degrees) up to 30 between two triangles with a common edge, and a little more. LIGGGHTS
// takes such surfaces as smooth.
double smooth_bend(const TriangleMesh& mesh);

}  // namespace grainreel
