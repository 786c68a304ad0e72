// The files of meshes and paths as a run keeps them, in the folder `meshes` of its own folder.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene.hpp"

namespace grainreel {

inline constexpr const char* kMeshFolder = "meshes";

struct KeptFile {
    std::string from, hash;  // path, and what is in it
    std::string name;        // "meshes/drum.stl", relative to the run's folder
};

// Each file once. Names are those of the files, with a number where two differ in nothing else. What the
// program ships is not kept.
std::vector<KeptFile> kept_files(const Scene& scene);

// The scene as it is written into its run's folder: it names the kept files. So do the scenes in checkpoints,
// and therefore a run's folder can be copied elsewhere.
Scene naming_kept_files(Scene scene);

}  // namespace grainreel
