// Copies of the files of meshes and paths in the folder of a run.
#pragma once

#include <filesystem>

#include "engine/scene/scene.hpp"

namespace grainreel {

// Puts each of kept_files() into the run's folder, unless it is there. previous: where the folder that had
// this name before is now, for files that lie in there; empty: there was none. Throws UserError where a file
// is no longer what was read of it, and RunError where it cannot be written.
void keep_mesh_files(const Scene& scene, const std::filesystem::path& folder,
                     const std::filesystem::path& previous = {});

// One file to a place of that name, whose folder is made. Throws as above.
void keep_file(const std::filesystem::path& from, const std::string& hash, const std::filesystem::path& to);

}  // namespace grainreel
