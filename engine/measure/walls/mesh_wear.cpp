#include "engine/measure/walls/mesh_wear.hpp"

#include "engine/scene/scene.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

std::string pressure_field(const std::string& name) {
    return "pressure_" + name;
}

std::string wear_field(const std::string& name) {
    return "wear_" + name;
}

std::vector<MeshWear> wear_among(const Scene& scene, const std::vector<const FieldSet*>& sets,
                                 const std::vector<FieldValues>& values) {
    const std::vector<std::string> names = face_names(scene);
    std::vector<MeshWear> all(scene.meshes.size());
    const auto find = [&](const std::string& name) -> std::vector<double> {
        for (std::size_t s = 0; s < sets.size(); ++s)
            for (std::size_t f = 0; f < sets[s]->fields.size(); ++f)
                if (sets[s]->fields[f].name == name) return values.at(s).at(f);
        return {};
    };
    for (std::size_t m = 0; m < all.size(); ++m) {
        const std::string& name = names.at(names.size() - all.size() + m);
        all[m] = {find(pressure_field(name)), find(wear_field(name))};
    }
    return all;
}

}  // namespace grainreel
