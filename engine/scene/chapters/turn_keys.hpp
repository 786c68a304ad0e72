// The keys of a steady turn, as container.turn and a mesh's turn have them. Internal to these.
#pragma once

#include <optional>
#include <string>

#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {

const keys::KeyTable<BodyTurn>& turn_table();

// Throws UserError where the value is no table, or makes no turn.
BodyTurn read_turn(Document& document, const Scene& scene, const std::string& path);

// A key `turn` whose value is a table, kept in `member`.
template <class T>
keys::BoundKey<T> turn_key(std::optional<BodyTurn> T::*member, const char* about) {
    return keys::bound_by<T>(
               keys::entry("turn", KeyKind::text, keys::note("none"), about),
               [member](Document& document, const Scene& scene, const std::string& path, T& into) {
                   if (document.has(path)) into.*member = read_turn(document, scene, path);
               },
               [member](const T& from, const Scene& scene) {
                   return from.*member ? turn_table().inline_text(scene, *(from.*member)) : std::string();
               })
        .holding(turn_table());
}

}  // namespace grainreel
