// What a page says of its runs side by side: their names, the keys in which their scenes differ, and how fast
// grains flow out (outflow_table.cpp).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "render/page/page_words.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct RunToName {
    std::filesystem::path folder;
    const FilmedScene& scene;
    std::string given = {};  // name that the user gave
};

// Names for runs: those that the user gave when there is one for each and no two are the same. Otherwise the
// titles of the scenes when no two are the same. Otherwise what differs between the
// scenes, "frequency = 20 Hz", when this is short and different for all of them. Otherwise the names of the
// folders, or their whole paths when two folders have the same name.
std::vector<std::string> names_of_runs(const std::vector<RunToName>& runs);

struct NamedScene {
    std::string name;
    std::filesystem::path file;  // scene.toml of a run
};

// A table of the keys whose values are not all the same, with a column for each scene; or a sentence that
// there are none.
std::string differences_html(const std::vector<NamedScene>& scenes, const PageWords& say);

// The table of how fast grains flow out of hoppers, beside what Beverloo's law expects: a row for each run
// from which grains flow; empty where there is none. RunToName::given is the name of the row, which a page of
// one run does not show.
std::string outflow_html(const std::vector<RunToName>& runs, const PageWords& say);

// The keys and values in the text of a run's scene.toml: "drive.frequency" -> "20", "species.2.count" -> "10"
// for the second species.
std::map<std::string, std::string> keys_of_scene(std::string_view text);

}  // namespace grainreel
