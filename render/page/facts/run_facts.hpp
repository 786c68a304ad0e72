// Reads what run.json says about a run, as far as it can be read, and writes the methods paragraph from it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/plan/plan.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct RunFacts {
    // "complete" and so on; "broken off" for an unfinished run on which no program works, "unknown" without
    // run.json.
    std::string status;
    std::string error;                                       // error of a run that failed
    std::vector<std::pair<std::string, std::string>> lines;  // name and text of each line on its origin
    std::string version, commit;                             // version and commit of the program that ran it
    std::string finished;                                    // UTC, ISO 8601; if unknown, when it started
    std::string state_hash;
    std::optional<std::int64_t> film_frames;
    std::int64_t trajectory_frames = 0;
    std::vector<std::string> warnings;
    std::int64_t measures_rows = 0;
    std::string fault;  // why nothing is known: "run.json: is missing"
};

// Reads run.json. Nothing in it is trusted: what it lacks, or has in another form, is left out.
RunFacts run_facts(const std::filesystem::path& folder);

// Text that an author can paste into a paper: the methods in a paragraph, and the sources as BibTeX.
struct Methods {
    std::string paragraph;  // sources are given by their keys in brackets: "[Walton1986]"
    std::string bibtex;
};

// lines: the plan in words, by name, as `grainreel check` prints them. The paragraph describes grains,
// container and drive in the same words.
Methods methods(const FilmedScene& scene, const Plan& plan, const RunFacts& facts,
                const std::vector<std::pair<std::string, std::string>>& lines);

}  // namespace grainreel
