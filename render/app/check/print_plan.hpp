// What `grainreel check` prints.
#pragma once

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "engine/plan/plan.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The plan of a scene in words: what is modelled and what is left out, how it will be computed, what will
// come out of it and what it will cost. Ends with the plan's warnings and the film's.
void print_plan(const FilmedScene& scene, const Plan& plan, std::ostream& out);

// The part of it that holds for a run that is over: lines of a name (empty where the line goes on with the
// one before) and a text, and the table of contacts, in columns.
struct PlanWords {
    std::vector<std::pair<std::string, std::string>> lines;
    std::string contacts;
};
PlanWords plan_words(const FilmedScene& scene, const Plan& plan);

}  // namespace grainreel
