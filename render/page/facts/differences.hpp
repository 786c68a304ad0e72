// In what the scenes of several runs differ.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace grainreel {

struct NamedScene {
    std::string name;
    std::filesystem::path file;  // scene.toml of a run
};

// A table of the keys whose values are not all the same, a column a scene; or that there are none.
std::string differences_html(const std::vector<NamedScene>& scenes);

// Keys and values of a resolved scene, as text: "drive.frequency" -> "20", "species.2.count" -> "10".
std::map<std::string, std::string> keys_of_scene(std::string_view text);

}  // namespace grainreel
