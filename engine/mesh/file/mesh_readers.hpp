// The readers of mesh files, and the choice of a reader by a file's content. Each reader takes the bytes and
// gives vertices and triangles in the file's unit. Polygons are cut into triangles from their first corner.
// Normals, colours, texture and materials are ignored, because the order of the corners gives the side. All
// readers throw UserError with file and line (text) or byte (binary).
//
// STL: 3D Systems, StereoLithography Interface Specification (1989). OBJ: Wavefront, Advanced Visualizer
// manual, appendix B1 (1993). PLY: G. Turk, The PLY Polygon File Format (1994).
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

enum class MeshFormat { binary_stl, ascii_stl, obj, ply };
const char* name_of(MeshFormat format);

// Finds the format by the content. Throws UserError for any other file. A binary STL whose size does not fit
// its count of triangles is not accepted.
MeshFormat format_of(const std::filesystem::path& file, std::string_view bytes);

TriangleMesh read_binary_stl(const std::filesystem::path& file, std::string_view bytes);
TriangleMesh read_ascii_stl(const std::filesystem::path& file, std::string_view bytes);
TriangleMesh read_obj(const std::filesystem::path& file, std::string_view bytes);
TriangleMesh read_ply(const std::filesystem::path& file, std::string_view bytes);
// Reads a mesh with the reader for this format.
TriangleMesh read_mesh(MeshFormat format, const std::filesystem::path& file, std::string_view bytes);

// The largest coordinate that is accepted, in the file's unit.
inline constexpr double largest_coordinate = 1e15;
std::string too_far(double coordinate);
// The reason why a word is no coordinate, and what to do: "\"nan\" is not a finite number; correct it, ...".
std::string no_coordinate(std::string_view word);

// The words with which a line of an OBJ file can begin.
inline bool is_obj_word(std::string_view word) {
    static constexpr std::array<std::string_view, 42> words{
        "v",     "vt",    "vn",   "vp",     "f",        "fo",       "l",      "p",          "g",
        "o",     "s",     "mg",   "mtllib", "usemtl",   "usemap",   "maplib", "cstype",     "deg",
        "bmat",  "step",  "curv", "curv2",  "surf",     "parm",     "trim",   "hole",       "scrv",
        "sp",    "end",   "con",  "bevel",  "c_interp", "d_interp", "lod",    "shadow_obj", "trace_obj",
        "ctech", "stech", "call", "csh",    "bsp",      "bzp"};
    return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace grainreel
