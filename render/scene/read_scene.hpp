// Reads a scene file into a scene with its film. The engine's reader does most of it; the keys of [film] are
// in keys/.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// All keys of a scene file: the engine's keys and the keys of [film].
const std::vector<Key>& filmed_scene_keys();

// These read as read_scene() of engine/scene/scene_file.hpp does, and also [film] and the species' colours.
// measurable: columns that plots and live words may name.
FilmedScene read_filmed_scene(const std::filesystem::path& file, const Assignments& sets = {},
                              const MeasurableIn& measurable = nullptr);
FilmedScene read_filmed_scene_text(std::string_view text, const std::filesystem::path& file,
                                   const Assignments& sets = {}, const MeasurableIn& measurable = nullptr);

}  // namespace grainreel
