// Makes a usable mesh of a file: it is read, placed and mended. STL (ASCII and binary), OBJ and PLY (ASCII
// and binary, both byte orders) are known. The content decides which it is, never the suffix. These files
// name no units: `scale` brings them to m.
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

// The same hash, of any file. Throws UserError where it cannot be read.
std::string hash_of_file(const std::filesystem::path& file);

// Joins equal vertices, drops triangles without area and doubled ones, and gives each connected part one
// orientation (winding.hpp). Vertices are equal that are closer than 1e-9 of the extent; along open edges,
// closer than 1e-5 of it and than a hundredth of the shortest such edge. Sets all of `facts` but format and
// read.
void mend(TriangleMesh& mesh, MeshFacts& facts);

}  // namespace grainreel
