// The scenes that lie beside frames, as the engine reads them.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/frame.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {

// "a/b/" and "a/b/." mean "a/b", and "." has a name too. Throws UserError when there is no such folder.
std::filesystem::path folder_of_run(const std::filesystem::path& folder);

// Throws UserError with the advice when the folder has no such file.
std::filesystem::path file_of_run(const std::filesystem::path& folder, const char* name, const char* advice);

// The scene.toml of a run's folder; named after the folder. Throws UserError for one that cannot be read.
Scene plain_scene_of_run(const std::filesystem::path& folder);

// The text of a checkpoint's scene as it was used, and what makes it start from the checkpoint, which does
// not say how its grains came to be. Whoever reads it adds own changes. Throws UserError where the file is
// none.
struct CheckpointScene {
    NamedText text;
    Assignments sets;
};
CheckpointScene scene_in_checkpoint(const std::filesystem::path& checkpoint);
Scene scene_of_checkpoint(const std::filesystem::path& checkpoint);

// The clock of a record's moments.

// A clock with steps of that length (s). With 0 it stands still.
Clock clock_of_steps(const Scene& scene, double step);

// The clock of a trajectory's frames, of which only the moments count. Its step is 0 when all are at step 0.
Clock clock_of(const Scene& scene, const std::vector<Frame>& moments);

}  // namespace grainreel
