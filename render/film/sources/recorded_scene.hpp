// Reads the scene of a saved run or checkpoint as it will be drawn, and finds how high the grains of a saved
// run got.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "engine/files/frames/state_archive.hpp"
#include "engine/run/stored/stored_run.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Checks that changes to a scene concern only the drawing (keys of [film], colours of species, run.threads),
// and adds what the purpose of a film implies. Throws UserError for other keys.
Assignments sets_for_drawing(const Assignments& sets);

// The scene.toml of a run with changes to the drawing, named after the folder. Throws UserError as above, and
// for a scene that cannot be read.
FilmedScene scene_of_run(const std::filesystem::path& folder, const Assignments& sets);

// A run on disk, or a single state of one, with the film by which it is drawn.
struct FilmedRun {
    std::unique_ptr<StoredRun> run;
    FilmedScene scene;
};
// Opens a run's folder, a single state, or files of another program, with changes to the drawing. The scene
// of a folder is named after it. A checkpoint holds its scene. A table of grains takes the scene.toml beside
// it; without one its species are "type 1", "type 2" and so on, of unknown density, in no container. Throws
// UserError as above and as StoredRun does. request.scene_of_run is not used.
FilmedRun open_filmed(const std::filesystem::path& path, const Assignments& sets,
                      StoredRunRequest request = {});

// How high the grains of a finished run got, in m above the floor's rest position: in every frame 99 of 100
// grains lie entirely below this height. Of a long trajectory with many grains only some evenly spread frames
// are read. Damaged frames do not count. Empty without grains.
std::optional<double> known_reach(const StateArchive& archive);

// The same height for one frame.
std::optional<double> reach_of(const State& frame);

}  // namespace grainreel
