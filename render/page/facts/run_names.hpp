// What the runs of a page are called, and in what their scenes differ.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
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

struct NamedScene {
    std::string name;
    std::filesystem::path file;  // scene.toml of a run
};

// A table of the keys whose values are not all the same, a column a scene; or that there are none.
std::string differences_html(const std::vector<NamedScene>& scenes);

// Keys and values of a resolved scene, as text: "drive.frequency" -> "20", "species.2.count" -> "10".
std::map<std::string, std::string> keys_of_scene(std::string_view text);

}  // namespace grainreel
