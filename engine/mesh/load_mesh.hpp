// Loads a mesh file: reads it, places the mesh in the scene and mends its faults. The formats are STL (ASCII
// and binary), OBJ and PLY (ASCII and binary, both byte orders). The content decides the format, never the
// suffix. These files name no units: `scale` brings them to m.
#pragma once

#include <filesystem>
#include <string>

#include "engine/base/triangle_mesh.hpp"
#include "engine/mesh/mesh_facts.hpp"

namespace grainreel {

// The place of a mesh in the scene: x = position + rotation (scale * x_file).
struct MeshPlacement {
    double scale = 1;
    Vec3 position{0, 0, 0};  // m
    Quaternion rotation = Quaternion::Identity();
};

struct LoadedMesh {
    TriangleMesh mesh;  // m, in the scene before anything moves
    MeshFacts facts;
    std::string hash;  // XXH64 of the file's bytes, as 16 hexadecimal digits
};

// Throws UserError, which gives the file and the line (text) or byte (binary), and says what is wrong and
// what to do. Nothing in the file is trusted: counts are bounded by the file's size before memory is
// allocated, and every number must be finite.
LoadedMesh load_mesh(const std::filesystem::path& file, const MeshPlacement& placement = {});

// The same hash for any file. Throws UserError if the file cannot be read.
std::string hash_of_file(const std::filesystem::path& file);

// Joins equal vertices, drops doubled triangles and triangles without area, and gives each connected part one
// orientation (winding.hpp). Vertices are equal if they are closer than 1e-9 of the extent. Two vertices on
// open edges are also equal if they are closer than 1e-5 of the extent, and closer than a hundredth of the
// shortest open edge that ends at either of them. Sets all members of `facts` except `format` and `read`.
void mend(TriangleMesh& mesh, MeshFacts& facts);

}  // namespace grainreel
