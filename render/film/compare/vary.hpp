// Several values of one key of a scene: `compare SCENE --vary drive.g_level=2,4`.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// What was typed after --vary: the key with each of its values, as --set takes them. Values are split at
// commas outside of brackets and quotes. Throws UserError for fewer than two values, an empty one, one that
// comes twice, and for a key of what all panels share.
std::vector<Assignment> read_vary(const std::string& typed);

// What tells the panels apart: "Γ = 2", "friction = 0.3", "density of big = 2500 kg/m3". scenes: read with
// the values, in the same order.
std::vector<std::string> labels_of(const std::vector<Assignment>& values,
                                   const std::vector<FilmedScene>& scenes);

// Whether the value changes what happens in the scene, and not its picture or its random choices alone.
bool changes_the_scene(const Assignment& value);

// "hopper-g_level-2", for its folder.
std::string name_with(const std::string& name, const Assignment& value);

}  // namespace grainreel
