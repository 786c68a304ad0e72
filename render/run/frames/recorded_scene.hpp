// The scene of a run that lies on disk, as it is to be drawn.
#pragma once

#include <filesystem>

#include "engine/scene/text/assignment.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// "a/b/" and "a/b/." mean "a/b", and "." has a name too. Throws UserError when there is no such folder.
std::filesystem::path folder_of_run(const std::filesystem::path& folder);

// Throws UserError with the advice when the folder has no such file.
std::filesystem::path file_of_run(const std::filesystem::path& folder, const char* name, const char* advice);

// Changes to a scene that are changes to what is drawn: keys of [film], colours of species, run.threads; with
// what the purpose of a film implies. Throws UserError for other keys.
Assignments sets_for_drawing(const Assignments& sets);

// Its scene.toml with such changes; named after the folder. Throws UserError likewise, and for a scene that
// cannot be read.
FilmedScene scene_of_run(const std::filesystem::path& folder, const Assignments& sets);

}  // namespace grainreel
