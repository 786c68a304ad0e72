// From a scene and its plan to what another engine is told.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/handover/carried_scene.hpp"

namespace grainreel {

struct CarryRequest {
    PeerEngine engine = PeerEngine::lammps;
    int ranks = 1;
    bool accept_law = false;  // a law that the engine has not may become the nearest that it has
    bool edinburgh = false;   // LIGGGHTS on one rank: Walton-Braun as it is
    // Above so many grains the deck packs by itself.
    std::int64_t packs_above = 1'000'000;
    // Steps of the pictures, in our count; those of the trajectory where there are none.
    std::vector<std::int64_t> dumps{};
};

// Never throws for what cannot be carried: all of it stands in `refusals`, and then only changes, engine and
// scene are of use. Throws UserError where the scene with its new law makes no plan.
CarriedScene carry(const Scene& scene, const Plan& plan, const CarryRequest& request);

// "file:line:column: what is wrong".
std::string refusal_text(const CarryNote& note);
// Throws UserError with all refusals, one a line; none: returns.
void throw_refusals(const CarriedScene& carried);

}  // namespace grainreel
