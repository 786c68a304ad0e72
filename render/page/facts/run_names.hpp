// What the runs of a page are called.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct RunToName {
    std::filesystem::path folder;
    const FilmedScene& scene;
};

// The titles of the scenes, where no two are the same. Else what differs between the scenes, "frequency = 20
// Hz", where that tells all of them apart and is short. Else the folders' names; their whole paths where two
// have the same.
std::vector<std::string> names_of_runs(const std::vector<RunToName>& runs);

}  // namespace grainreel
