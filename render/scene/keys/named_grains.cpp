// Reads and writes lists of species by name and of grains by id.
#include "render/scene/keys/named_grains.hpp"

#include <fmt/format.h>

#include "engine/base/text.hpp"

namespace grainreel {
namespace {

// The index of a species that is named at `path`.
std::size_t species_at(const Document& document, const Scene& scene, const std::string& path,
                       const std::string& name) {
    std::string known;
    for (std::size_t i = 0; i < scene.species.size(); ++i) {
        if (scene.species[i].name == name) return i;
        known += (i > 0 ? ", \"" : "\"") + excerpt(scene.species[i].name) + "\"";
    }
    document.fail(
        path, fmt::format("names the species \"{}\", which is not there; there is {}", excerpt(name), known));
}

}  // namespace

std::vector<std::size_t> species_list(Document& document, const Scene& scene, const std::string& path) {
    std::vector<std::size_t> list;
    for (const std::string& name : document.name_list(path))
        list.push_back(species_at(document, scene, path, name));
    return list;
}

std::vector<std::int32_t> ids_at(Document& document, const Scene& scene, const std::string& path) {
    std::vector<std::int32_t> ids;
    for (const std::int64_t id : document.integer_list(path)) {
        if (id >= scene.grains())
            document.fail(path,
                          fmt::format("has the id {}, but ids run from 0 to {}", id, scene.grains() - 1));
        ids.push_back(static_cast<std::int32_t>(id));
    }
    return ids;
}

std::string species_text(const std::vector<std::size_t>& chosen, const Scene& scene) {
    std::vector<std::string> words;
    for (const std::size_t s : chosen) words.push_back(quoted(scene.species[s].name));
    return words.empty() ? "" : toml_list(words);
}

std::string ids_text(const std::vector<std::int32_t>& ids) {
    std::vector<std::string> words;
    for (const std::int32_t id : ids) words.push_back(std::to_string(id));
    return words.empty() ? "" : toml_list(words);
}

}  // namespace grainreel
