// The scenes that lie beside frames, as the engine reads them.
#pragma once

#include <filesystem>

#include "engine/scene/scene.hpp"
#include "engine/scene/text/assignment.hpp"

namespace grainreel {

// "a/b/" and "a/b/." mean "a/b", and "." has a name too. Throws UserError when there is no such folder.
std::filesystem::path folder_of_run(const std::filesystem::path& folder);

// Throws UserError with the advice when the folder has no such file.
std::filesystem::path file_of_run(const std::filesystem::path& folder, const char* name, const char* advice);

// The scene.toml of a run's folder; named after the folder. Throws UserError for one that cannot be read.
Scene plain_scene_of_run(const std::filesystem::path& folder);

// The scene of a checkpoint as it was used; it starts from the checkpoint. Throws UserError where the file is
// none.
Scene plain_scene_of_checkpoint(const std::filesystem::path& checkpoint);

// What makes a scene start from the checkpoint, which does not say how its grains came to be.
Assignments started_from(const std::filesystem::path& checkpoint);
// Its scene as text. Throws UserError likewise.
std::string scene_text_of_checkpoint(const std::filesystem::path& checkpoint);

}  // namespace grainreel
