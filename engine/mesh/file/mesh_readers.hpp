// The readers of mesh files: each takes the bytes and gives vertices and triangles in the file's unit, with
// polygons cut into triangles from their first corner. Normals, colours, texture and materials are left out:
// the order of the corners gives the side. All throw UserError with file and line (text) or byte (binary).
//
// STL: 3D Systems, StereoLithography Interface Specification (1989). OBJ: Wavefront, Advanced Visualizer
// manual, appendix B1 (1993). PLY: G. Turk, The PLY Polygon File Format (1994).
#pragma once

#include <filesystem>
#include <string_view>

#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

enum class MeshFormat { binary_stl, ascii_stl, obj, ply };
const char* name_of(MeshFormat format);

// By content. Throws UserError for what is none of them; a binary STL whose size does not fit its count of
// triangles is none.
MeshFormat format_of(const std::filesystem::path& file, std::string_view bytes);

TriangleMesh read_binary_stl(const std::filesystem::path& file, std::string_view bytes);
TriangleMesh read_ascii_stl(const std::filesystem::path& file, std::string_view bytes);
TriangleMesh read_obj(const std::filesystem::path& file, std::string_view bytes);
TriangleMesh read_ply(const std::filesystem::path& file, std::string_view bytes);
// By the one of these that the format names.
TriangleMesh read_mesh(MeshFormat format, const std::filesystem::path& file, std::string_view bytes);

}  // namespace grainreel
