// What run.json says of a run, as far as it can be read, and the methods paragraph that follows from it.
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
    // "complete"; "broken off" where nobody works on a run that was not finished, "unknown" without run.json.
    std::string status;
    std::string error;                                       // of a run that failed
    std::vector<std::pair<std::string, std::string>> lines;  // name and text of its provenance
    std::string version, commit;                             // of the program that ran it
    std::string finished;                                    // UTC, ISO 8601; or when it started
    std::string state_hash;
    std::optional<std::int64_t> film_frames;
    std::int64_t trajectory_frames = 0;
    std::vector<std::string> warnings;
    std::int64_t measures_rows = 0;
    std::string fault;  // why nothing is known: "run.json: is missing"
};

// Whatever the file lacks or has in another form is left out: nothing of it is trusted.
RunFacts run_facts(const std::filesystem::path& folder);

// What an author pastes into a paper: the methods in a paragraph, and the sources as BibTeX.

struct Methods {
    std::string paragraph;  // keys of the sources in brackets: "[Walton1986]"
    std::string bibtex;
};

// lines: the plan in words, by name, as `grainreel check` has them; grains, container and drive are told in
// the same words.
Methods methods(const FilmedScene& scene, const Plan& plan, const RunFacts& facts,
                const std::vector<std::pair<std::string, std::string>>& lines);

}  // namespace grainreel
