#include "engine/state/face_names.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "engine/scene/measure_columns.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

std::vector<std::string> face_names(const Scene& scene) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    const auto add = [&](const std::string& name) {
        std::string part = column_part(name);
        std::replace(part.begin(), part.end(), ' ', '_');
        const std::string first = part;
        for (int number = 2; !taken.insert(part).second; ++number) part = fmt::format("{}_{}", first, number);
        names.push_back(part);
    };
    for (const Face& face : faces_of(scene)) add(face.name);
    for (const SceneMesh& mesh : scene.meshes) add(mesh.name);
    return names;
}

}  // namespace grainreel
