// What a card does not take, and why.
#pragma once

#include <string>

#include "engine/plan/plan.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel::card {

// The first thing in a run that cannot be computed on a card, by its name, or "" if all can. To be asked
// before anything is packed.
std::string what_a_card_refuses(const Plan& plan, const Surroundings& around);

}  // namespace grainreel::card
