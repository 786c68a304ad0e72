// Why values that a scene leaves open are what they are, for a scene in which they have been filled in.
#pragma once

#include <string>
#include <vector>

namespace grainreel {

// Empty where the scene itself says the value.
struct Reasons {
    std::string step;
    // Why a stiffness was filled in, or the modulus with Hertz. By kind of contact as in Contact; `glued`:
    // for contacts with grains glued to walls. Without an entry where nothing was filled in.
    std::vector<std::string> grain, wall, mesh, glued;
};

}  // namespace grainreel
