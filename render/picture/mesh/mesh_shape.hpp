// The shape of a mesh as it is drawn, found once for each mesh: its vertices, its edges and the normals at
// its corners (mesh_shape.cpp), and which of its sides are solid and which are glass (mesh_sides.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/base/triangle_mesh.hpp"
#include "engine/base/vector.hpp"

namespace grainreel {

struct Neighbour;  // engine/mesh/surface.hpp
class Surface;     // there too

// vessel: solid where it is seen from inside, glass from outside. solid, glass: the same from both sides.
// automatic: decided for each connected part, by how much its sides look into something that the mesh
// encloses.
enum class MeshLook { automatic, vessel, solid, glass };

struct MeshShape {
    struct Edge {
        std::int32_t from, to;                   // vertices
        std::int32_t left, right;                // triangles; right is -1 at an open edge
        std::uint8_t left_corner, right_corner;  // for each triangle, its corner that is not on the edge
        bool feature;  // drawn wherever it is seen; other edges only as part of an outline
        bool rippled;  // beside a part of a twisted surface that was cut into triangles; never drawn as an
                       // outline
    };
    // How a triangle looks from the side that its normal points to, and from the other side. If a
    // closed surface is the skin of a solid body, the side towards the body is `unseen`.
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

// edge_angle: rad; an edge is a feature edge if its two triangles make a larger angle (0 is flat), and also
// where the mesh ends or normals flip. Folds of a twisted surface, up and down from triangle to triangle, are
// no feature edges.
std::shared_ptr<const MeshShape> mesh_shape(const Surface& surface, double edge_angle, MeshLook look);

// Numbers the patches of triangles that are connected across edges of at most `edge_angle`. Returns the
// number of each triangle's patch, from 0 on.
std::vector<std::int32_t> smooth_patches(const Surface& surface, double edge_angle);

// rad: the angle between the planes of a triangle and its neighbour across an edge.
double turn_of(const Surface& surface, std::int32_t triangle, const Neighbour& neighbour);

// How both sides of each triangle are drawn. This depends on whether a side faces a space that the mesh
// encloses. A few rays from each patch tell how much of a side's view is filled by the mesh itself.
std::vector<MeshShape::Sides> find_sides(const Surface& surface, double edge_angle, MeshLook look);

}  // namespace grainreel
