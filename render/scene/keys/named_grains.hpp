// Keys of the film whose values are lists of species by name or of grains by id.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {

// The indices of the species that the list at `path` names; empty without a list. Throws UserError for a name
// that no species has.
std::vector<std::size_t> species_list(Document& document, const Scene& scene, const std::string& path);
// The ids of the list at `path`. Throws UserError for an id that no grain has.
std::vector<std::int32_t> ids_at(Document& document, const Scene& scene, const std::string& path);

// The lists as TOML; empty for empty lists.
std::string species_text(const std::vector<std::size_t>& chosen, const Scene& scene);
std::string ids_text(const std::vector<std::int32_t>& ids);

template <class T>
keys::BoundKey<T> species_key(const char* name, std::vector<std::size_t> T::*member, const char* about) {
    return keys::bound_by<T>(
        keys::entry(name, KeyKind::name_list, keys::note("none"), about),
        [member](Document& document, const Scene& scene, const std::string& path, T& into) {
            into.*member = species_list(document, scene, path);
        },
        [member](const T& from, const Scene& scene) { return species_text(from.*member, scene); });
}

template <class T>
keys::BoundKey<T> ids_key(const char* name, std::vector<std::int32_t> T::*member, const char* about) {
    Key key = keys::integer(name, 0, keys::most_grains, keys::note("none"), about);
    key.kind = KeyKind::integer_list;
    return keys::bound_by<T>(
        std::move(key),
        [member](Document& document, const Scene& scene, const std::string& path, T& into) {
            into.*member = ids_at(document, scene, path);
        },
        [member](const T& from, const Scene&) { return ids_text(from.*member); });
}

}  // namespace grainreel
