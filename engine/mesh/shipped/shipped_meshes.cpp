#include "engine/mesh/shipped/shipped_meshes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"

namespace grainreel {
namespace {

constexpr std::string_view prefix = "shipped:";

}  // namespace

bool is_shipped_mesh(const std::filesystem::path& file) {
    return file.filename().string().starts_with(prefix);
}

std::optional<std::string_view> shipped_mesh(const std::filesystem::path& file) {
    if (!is_shipped_mesh(file)) return std::nullopt;
    const std::string name = file.filename().string().substr(prefix.size());
    std::vector<std::string> names;
    for (const ShippedMesh& mesh : shipped_meshes()) {
        if (mesh.name == name) return mesh.bytes;
        names.push_back(mesh.name);
    }
    throw UserError(fmt::format("{}{}: the program has no such mesh; it has {}", prefix, excerpt(name),
                                fmt::join(names, ", ")));
}

}  // namespace grainreel
