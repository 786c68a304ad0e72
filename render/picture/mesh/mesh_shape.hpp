// What is drawn of a mesh, found once: its vertices, its normals at corners, its edges, and which of its
// sides are solid and which are glass.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/mesh/surface.hpp"

namespace grainreel {

// A vessel shows its inner side solid and is glass from outside. An insert is solid from both sides.
// automatic: by how much of its surface encloses something.
enum class MeshLook { automatic, vessel, solid, glass };

struct MeshShape {
    struct Edge {
        std::int32_t from, to;                   // vertices
        std::int32_t left, right;                // triangles; right is -1 at an open edge
        std::uint8_t left_corner, right_corner;  // of each, the corner that is not on the edge
        bool feature;  // drawn wherever it is in sight, else only as part of an outline
        bool rippled;  // of a triangle that stands for a twisted surface
    };
    // How a triangle looks from the side that its normal points to, and from the other one. Material that
    // fills a closed surface is on the unseen side.
    enum class Face : std::uint8_t { solid, glass, unseen };
    struct Sides {
        Face front = Face::solid, back = Face::solid;
    };

    std::vector<Vec3> vertices;  // m, at rest
    std::vector<TriangleMesh::Triangle> triangles;
    std::vector<Vec3> normals;                            // unit, a triangle
    std::vector<std::array<Eigen::Vector3f, 3>> corners;  // unit normals, smooth but across feature edges
    std::vector<Edge> edges;
    std::vector<Sides> sides;  // a triangle
};

// edge_angle: rad; edges whose faces turn more are feature edges.
std::shared_ptr<const MeshShape> mesh_shape(const Surface& surface, double edge_angle, MeshLook look);

// Triangles that hang together without a feature edge between them: a number for each triangle, from 0 on.
std::vector<std::int32_t> smooth_patches(const Surface& surface, double edge_angle);

// rad, between the planes of a triangle and its neighbour across an edge.
double turn_of(const Surface& surface, std::int32_t triangle, const Neighbour& neighbour);

// Which sides of a mesh look into something that it encloses, and which look out.

// The sides of each triangle. A side is told by how much of what is around it is surface again: a few rays
// from each patch say so.
std::vector<MeshShape::Sides> find_sides(const Surface& surface, double edge_angle, MeshLook look);

}  // namespace grainreel
