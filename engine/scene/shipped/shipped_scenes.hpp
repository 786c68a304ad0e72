// The scenes of the folder scenes/, which the build puts into the program: they can be run by name wherever
// the program is.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grainreel {

struct ShippedScene {
    std::string name;       // of its file, without .toml
    std::string_view text;  // TOML

    // The first sentence of the comment that the file begins with.
    std::string about() const;
};

// In alphabetical order.
const std::vector<ShippedScene>& shipped_scenes();

// The one with this name, with .toml or without; "-" counts as "_". Null when there is none.
const ShippedScene* shipped_scene(std::string_view name);

// The scene of this name, or the only one whose name contains it: "brazil-nut" is teaching_brazil_nut.
const ShippedScene* shipped_scene_like(std::string_view words);

// The name that somebody meant who mistyped one. Empty when none is near.
std::optional<std::string> nearest_shipped_scene(std::string_view name);

}  // namespace grainreel
