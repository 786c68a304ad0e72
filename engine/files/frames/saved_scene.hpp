// Scenes that were saved with a run, in its folder or in a checkpoint, and the clock of its frames. They are
// read as the engine reads them, without [film].
#pragma once

#include <filesystem>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

struct Clock;  // engine/base/clock.hpp

// The folder's path in its usual form: "a/b/" and "a/b/." become "a/b", and "." becomes the folder's name.
// Throws UserError when there is no such folder.
std::filesystem::path folder_of_run(const std::filesystem::path& folder);

// The path of a file in the folder. Throws UserError with the advice when there is no such file.
std::filesystem::path file_of_run(const std::filesystem::path& folder, const char* name, const char* advice);

// Why a run may have no trajectory.nc.
inline constexpr const char* kWithoutTrajectory =
    "the run kept none: it was told so (output.trajectory = false), or it ended before its first frame";

// The scene.toml of a run's folder. The scene is named after the folder. Throws UserError when it cannot be
// read.
Scene plain_scene_of_run(const std::filesystem::path& folder);

// The scene that a checkpoint holds, as text. A checkpoint does not say how its grains were made; `sets`
// makes the scene start from the checkpoint instead. The caller may add settings of its own.
struct CheckpointScene {
    NamedText text;
    Assignments sets;
};
// Throws UserError where the file is no checkpoint.
CheckpointScene scene_in_checkpoint(const std::filesystem::path& checkpoint);
Scene scene_of_checkpoint(const std::filesystem::path& checkpoint);

// The scene's clock with steps of that length (s). With 0 it stands still.
Clock clock_of_steps(const Scene& scene, double step);

// The clock of these moments, from their times and steps. Its step is 0 when all are at step 0.
Clock clock_of(const Scene& scene, const std::vector<State>& moments);

}  // namespace grainreel
