// Gives the bytes of a mesh file, which is on disk or built into the program, and throws the errors about
// mesh files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

}  // namespace grainreel
