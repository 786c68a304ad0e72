// What an author pastes into a paper: the methods in a paragraph, and the sources as BibTeX.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/plan/plan.hpp"
#include "render/page/facts/run_facts.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct Methods {
    std::string paragraph;  // keys of the sources in brackets: "[Walton1986]"
    std::string bibtex;
};

// lines: the plan in words, by name, as `grainreel check` has them; grains, container and drive are told in
// the same words.
Methods methods(const FilmedScene& scene, const Plan& plan, const RunFacts& facts,
                const std::vector<std::pair<std::string, std::string>>& lines);

}  // namespace grainreel
