// The meshes of scenes/meshes, which the build puts into the program, so that the program's own scenes find
// them wherever the program is. In a scene such a file is called "shipped:drum.stl".
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grainreel {

struct ShippedMesh {
    std::string name;        // name of the file, "drum.stl"
    std::string_view bytes;  // bytes of the file
};

// All shipped meshes in alphabetical order.
const std::vector<ShippedMesh>& shipped_meshes();

// Whether the file's name begins with "shipped:".
bool is_shipped_mesh(const std::filesystem::path& file);

// The bytes of the mesh that such a name stands for, whatever folder stands before it. Empty for any other
// name. Throws UserError if the program has no such mesh.
std::optional<std::string_view> shipped_mesh(const std::filesystem::path& file);

}  // namespace grainreel
