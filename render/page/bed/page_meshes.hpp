// Meshes of a scene as the page carries them: each shape once, at rest. The bodies of a frame say where the
// shapes are at that moment.
//
// The bytes, before they are packed, are for each mesh of V vertices, T triangles and E edges, little-endian:
//   x, y and z of the vertices, each as V low bytes and V high bytes of a zigzag difference from the vertex
//   before (from 0 at first), in 65535ths of the mesh's box;
//   the three corners of triangles, each as T low, T middle and T high bytes of a zigzag difference from the
//   triangle before; the two ends of edges in the same way, E bytes each.
// The first triangles are solid from both sides, the next `glass` ones are glass, and the last `sided` ones
// are solid on the side of their normal and glass on the other side. render/page/html/meshes.js reads them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/triangle_mesh.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/state.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct PageMesh {
    std::int32_t body = 0;  // its number in State::bodies (engine/state/pose.hpp)
    std::string name;
    std::size_t vertices = 0, triangles = 0, glass = 0, sided = 0, edges = 0;
    std::size_t all_triangles = 0;     // number of triangles of the scene's mesh
    Vec3 low{0, 0, 0}, high{0, 0, 0};  // m, the box which 16 bits span
    bool whole() const { return triangles == all_triangles; }
};

struct PageMeshes {
    std::vector<PageMesh> meshes;      // a mesh without triangles is left out of the page
    std::vector<std::uint8_t> packed;  // in zlib's format; empty without meshes
    // Sentences about meshes that are thinned or left out.
    std::vector<std::string> notes() const;
};

constexpr std::size_t kMostTrianglesOnPage = 60000;

// All meshes, thinned until together they have at most `most_bytes` packed bytes. Their sides are solid or
// glass as in the film.
PageMeshes page_meshes(const FilmedScene& scene, std::size_t most_bytes,
                       std::size_t most_triangles = kMostTrianglesOnPage);

// Enlarges the box so that it holds the meshes at these moments. Of many moments or vertices it looks at a
// sample.
void take_meshes(Extent& box, const Scene& scene, const std::vector<State>& moments);

// Fewer triangles of the same shape: the vertices in a cell of a cubic grid become one, their mean, and
// triangles whose corners are no longer three different ones vanish (Rossignac and Borrel 1993,
// Multi-resolution 3D approximations for rendering complex scenes).
struct ThinnedMesh {
    TriangleMesh mesh;
    std::vector<std::int32_t>
        triangle_from;  // for each triangle, the triangle of the whole mesh from which it comes
    std::vector<std::int32_t>
        vertex_into;  // for each vertex of the whole mesh, the vertex into which it was merged
};

// The mesh with at most `most_triangles` triangles. A mesh that has no more is returned unchanged.
ThinnedMesh thinned(const TriangleMesh& mesh, std::size_t most_triangles);

}  // namespace grainreel
