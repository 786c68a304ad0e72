// The scenes and studies of the folder scenes/, which the build puts into the program, so that they can be
// run by name anywhere.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grainreel {

struct ShippedScene {
    std::string name;       // name of its file, without .toml
    std::string_view text;  // TOML

    // The first sentence of the comment at the top of the file.
    std::string about() const;
};

// All shipped scenes, in alphabetical order.
const std::vector<ShippedScene>& shipped_scenes();
// Those of scenes/studies likewise, which name shipped scenes, and the tables of points (CSV) beside them,
// whose names have ".csv".
const std::vector<ShippedScene>& shipped_studies();
const std::vector<ShippedScene>& shipped_tables();

// The functions below look in a list: among scenes, or among studies.

// The scene of this name, with .toml or without; "-" counts as "_". Null when there is none.
const ShippedScene* shipped_scene(std::string_view name,
                                  const std::vector<ShippedScene>& among = shipped_scenes());

// The scenes whose names contain these words: "hopper" gives cone_hopper, hopper_discharge ...
std::vector<const ShippedScene*> shipped_scenes_with(
    std::string_view words, const std::vector<ShippedScene>& among = shipped_scenes());

// The scene of this name, or the only one whose name contains these words: "brazil-nut" is
// teaching_brazil_nut.
const ShippedScene* shipped_scene_like(std::string_view words,
                                       const std::vector<ShippedScene>& among = shipped_scenes());

// The name of a shipped scene that is nearest to a mistyped one. Empty when none is near.
std::optional<std::string> nearest_shipped_scene(std::string_view name,
                                                 const std::vector<ShippedScene>& among = shipped_scenes());

}  // namespace grainreel
