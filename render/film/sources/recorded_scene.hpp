// The scene of a saved run or checkpoint as it is to be drawn, and how high the grains of a saved run got.
#pragma once

#include <filesystem>
#include <optional>

#include "engine/files/frames/frame_archive.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Changes to a scene that are changes to what is drawn: keys of [film], colours of species, run.threads; with
// what the purpose of a film implies. Throws UserError for other keys.
Assignments sets_for_drawing(const Assignments& sets);

// Its scene.toml with such changes; named after the folder. Throws UserError as above, and for a scene that
// cannot be read.
FilmedScene scene_of_run(const std::filesystem::path& folder, const Assignments& sets);

// The scene of a checkpoint as it was used, with such changes; named after the file. Throws UserError
// as above.
FilmedScene scene_of_checkpoint_to_draw(const std::filesystem::path& checkpoint, const Assignments& sets);

// How high the grains of a finished run got: m above the floor's rest position: below it are 99 of 100
// grains, whole, in every frame. Of a long record of many grains evenly spread frames are read. Damaged
// frames do not count. Empty without grains.
std::optional<double> known_reach(const FrameArchive& archive);

// The same of one frame.
std::optional<double> reach_of(const Frame& frame);

}  // namespace grainreel
