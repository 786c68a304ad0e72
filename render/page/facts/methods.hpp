// What a page tells of a run's origin: its run.json in words, and the methods paragraph.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/files/run_json.hpp"
#include "engine/plan/plan.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// run.json of a folder, with the status as a page tells it: "broken off" for an unfinished run on which no
// program works, and "unknown" where the file has none.
ReadRunJson record_of_page(const std::filesystem::path& folder);

// Name and text of each line on the origin of a run.
std::vector<std::pair<std::string, std::string>> origin_lines(const ReadRunJson& run);

// Text that an author can paste into a paper: the methods in a paragraph, and the sources as BibTeX.
struct Methods {
    std::string paragraph;  // sources are given by their keys in brackets: "[Walton1986]"
    std::string bibtex;
};

// lines: the plan in words, by name, as `grainreel check` prints them. The paragraph describes grains,
// container, drive and start in the same words. seeds: "seeds 1, 2, 3"; empty for the seed of the scene.
Methods methods(const FilmedScene& scene, const Plan& plan, const RunJson& record,
                const std::vector<std::pair<std::string, std::string>>& lines, const std::string& seeds = "");

}  // namespace grainreel
