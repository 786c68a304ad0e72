// The shape of a mesh as it is drawn, found once for each mesh: its vertices, normals at corners and edges
// (mesh_shape.cpp), and which of its sides are solid and which are glass (mesh_sides.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/mesh/surface.hpp"

namespace grainreel {

// vessel: solid where it is seen from inside, glass from outside. solid: from both sides, as for an insert.
// automatic: one of these, by the share of the surface that encloses something.
enum class MeshLook { automatic, vessel, solid, glass };

struct MeshShape {
    struct Edge {
        std::int32_t from, to;                   // vertices
        std::int32_t left, right;                // triangles; right is -1 at an open edge
        std::uint8_t left_corner, right_corner;  // for each triangle, its corner that is not on the edge
        bool feature;  // drawn wherever it is seen; other edges only as part of an outline
        bool rippled;  // at a triangle that stands for a part of a twisted surface (mesh_shape.cpp)
    };
    // How a triangle looks from the side that its normal points to, and from the other side. Where material
    // fills a closed surface, it is on the unseen side.
    enum class Face : std::uint8_t { solid, glass, unseen };
    struct Sides {
        Face front = Face::solid, back = Face::solid;
    };

    std::vector<Vec3> vertices;  // m, at rest
    std::vector<TriangleMesh::Triangle> triangles;
    std::vector<Vec3> normals;                            // unit, one for each triangle
    std::vector<std::array<Eigen::Vector3f, 3>> corners;  // unit normals, smooth except across feature edges
    std::vector<Edge> edges;
    std::vector<Sides> sides;  // one for each triangle
};

// edge_angle: rad; edges whose faces turn more are feature edges.
std::shared_ptr<const MeshShape> mesh_shape(const Surface& surface, double edge_angle, MeshLook look);

// Numbers the patches of triangles that are connected without a feature edge between them. Returns the number
// of each triangle's patch, from 0 on.
std::vector<std::int32_t> smooth_patches(const Surface& surface, double edge_angle);

// rad: the angle between the planes of a triangle and its neighbour across an edge.
double turn_of(const Surface& surface, std::int32_t triangle, const Neighbour& neighbour);

// How both sides of each triangle look, which depends on whether they look into something that the mesh
// encloses or out of it. A few rays from each patch tell how much of a side's view is filled by the mesh
// itself.
std::vector<MeshShape::Sides> find_sides(const Surface& surface, double edge_angle, MeshLook look);

}  // namespace grainreel
