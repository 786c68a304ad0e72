// The parts of [container] that have tables of their own: turn, outlet, tray and glued grains. Each function
// gives one key; each check looks at a whole scene. Only files of this folder include this header.
#pragma once

#include <optional>
#include <string>

#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {

const keys::KeyTable<BodyTurn>& turn_table();

// Throws UserError where the value is no table, or does not describe a turn.
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

// The keys of container.outlet. Internal to [container].

// The key is read after all that gives the container's size.
keys::BoundKey<Container> outlet_key();

// Throws UserError where an outlet does not suit its container or the grains.
void check_outlet(const Scene& scene);

// The keys of container.tray. Internal to [container].

// The key is read after the outlet.
keys::BoundKey<Container> tray_key();

// Throws UserError where a tray does not suit its container.
void check_tray(const Scene& scene);

// The keys of container.wall_grains. Internal to [container].

// The key is read after all that gives the container's size.
keys::BoundKey<Container> wall_grains_key();

// Throws UserError where glued grains do not suit their container.
void check_wall_grains(const Scene& scene);

// Whether a species of this number and name is that of the glued grains; for use before the container is
// read.
bool is_glued(Document& document, std::size_t number, const std::string& name);

}  // namespace grainreel
