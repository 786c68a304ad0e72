// Makes a mesh that can be used out of a file: read, placed, mended. STL (ASCII and binary), OBJ and PLY
// (ASCII and binary, both byte orders). The content decides which it is, and never the suffix. Units are
// nowhere in these files: `scale` brings them to m.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

// How a mesh from a file stands in the scene: x = position + rotation (scale * x_file).
struct MeshPlacement {
    double scale = 1;
    Vec3 position{0, 0, 0};  // m
    Quaternion rotation = Quaternion::Identity();
};

struct LoadedMesh {
    TriangleMesh mesh;  // m, in the scene at rest
    MeshFacts facts;
    std::string hash;  // of the file's bytes, XXH64 as 16 hexadecimal digits
};

// Throws UserError with file and line (text) or byte (binary): what is wrong and what to do. Nothing in the
// file is trusted: a count is bounded by the file's size before memory is asked for, and every number must be
// finite.
LoadedMesh load_mesh(const std::filesystem::path& file, const MeshPlacement& placement = {});

// The same hash of any file. Throws UserError where it cannot be read.
std::string hash_of_file(const std::filesystem::path& file);

// Joins equal vertices (closer than 1e-9 of the extent; along open edges than 1e-5 of it and than a hundredth
// of the shortest such edge), drops triangles without area and doubled ones, and makes the order of each
// connected part consistent (winding.hpp). Fills in all of `facts` but format and read.
void mend(TriangleMesh& mesh, MeshFacts& facts);

// Joins vertices that are close to each other.

// Vertices to be joined: two that lie within `reach` (m) of each other, and within the room that each of them
// has.
struct Welding {
    const std::vector<Vec3>& vertices;
    double reach = 0;
    std::vector<double> room;  // m, by vertices; empty: only `reach` counts
};
// Looks at those named in `which` (all different, rising). Gives for each vertex the one that takes its
// place: itself, or the first one looked at that it can be joined with.
std::vector<std::int32_t> joined(const Welding& welding, const std::vector<std::int32_t>& which);

// Gives the triangles the vertices that take the place of theirs. Returns how many vertices went.
std::int64_t replace_vertices(TriangleMesh& mesh, const std::vector<std::int32_t>& place_of);

// Leaves out vertices that no triangle has; the rest come in the order in which the triangles name them.
void drop_unused_vertices(TriangleMesh& mesh);

}  // namespace grainreel
