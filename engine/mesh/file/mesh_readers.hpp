// Gives the bytes of a mesh file, which is on disk or built into the program, and reads them. The content of
// a file chooses its reader. Each reader gives vertices and triangles in the file's unit. Polygons are cut
// into triangles from their first corner. Normals, colours, texture and materials are ignored, because the
// order of the corners gives the side. All readers throw UserError with file and line (text) or byte
// (binary).
//
// STL: 3D Systems, StereoLithography Interface Specification (1989). OBJ: Wavefront, Advanced Visualizer
// manual, appendix B1 (1993). PLY: G. Turk, The PLY Polygon File Format (1994).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/lists.hpp"
#include "engine/base/triangle_mesh.hpp"

namespace grainreel {

// Largest size of a mesh file, in bytes, because indices of vertices and triangles are 32 bits wide.
inline constexpr std::uint64_t largest_mesh_file = (std::uint64_t{1} << 31) - 1;

// Reads all bytes of a shipped mesh or of an ordinary file. Throws UserError if the file does not exist,
// cannot be read, is empty or larger than 2 GiB, or is a folder, a pipe or a device.
std::string mesh_bytes(const std::filesystem::path& file);

// A mesh of scenes/meshes. The build puts these files into the program, so that the program's own scenes find
// them wherever the program is. In a scene such a file is called "shipped:drum.stl".
struct ShippedMesh {
    std::string name;        // name of the file, "drum.stl"
    std::string_view bytes;  // bytes of the file
};

// All shipped meshes in alphabetical order.
const std::vector<ShippedMesh>& shipped_meshes();

// Whether the file's name begins with "shipped:".
bool is_shipped_mesh(const std::filesystem::path& file);

// The bytes of a shipped mesh by its name; a folder before "shipped:" is ignored. Empty for any other name.
// Throws UserError if the program has no such mesh.
std::optional<std::string_view> shipped_mesh(const std::filesystem::path& file);

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
    return contains(words, word);
}

}  // namespace grainreel
