// From a scene file to a scene with its film.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// All keys of a scene file: the engine's and those of [film].
const std::vector<Key>& filmed_scene_keys();

// As read_scene() of engine/scene/scene_file.hpp, with [film] and the species' colours. measurable: what
// plots and live words may name, too.
FilmedScene read_filmed_scene(const std::filesystem::path& file, const Assignments& sets = {},
                              const MeasurableIn& measurable = nullptr);
FilmedScene read_filmed_scene_text(std::string_view text, const std::filesystem::path& file,
                                   const Assignments& sets = {}, const MeasurableIn& measurable = nullptr);

}  // namespace grainreel
