// From a scene and its plan to what another engine is told.
#pragma once

#include <cstdint>
#include <optional>
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

// Parts of carry(), for the files that make it up.

void add_change(CarriedScene& carried, const std::string& where, const std::string& what,
                const std::string& why);
void add_refusal(CarriedScene& carried, const std::string& where, const std::string& what);

// The laws of carried.scene become those that the engine has; says what that changes, or that it is not
// asked for. `plan` is that of the scene before.
void carry_laws(const CarryRequest& request, const Plan& plan, CarriedScene& carried);
// The numbers of all contacts, from carried.plan.
void carry_contacts(const CarryRequest& request, CarriedScene& carried);
// Walls, frame and drive.
void carry_walls(CarriedScene& carried);
// What comes and goes, how the grains begin, and what is kept of the run.
void carry_run(const CarryRequest& request, CarriedScene& carried);

// How LAMMPS' own formulas must be told a dashpot of ours. engine/plan/damping.hpp solves for the
// restitution.

// LAMMPS' `damping tsuji` takes a restitution e and makes the damping
//   alpha = 1.2728 - 4.2783 e + 11.087 e^2 - 22.348 e^3 + 27.467 e^4 - 18.022 e^5 + 4.8218 e^6
// of it (manual, pair_style granular), for N_d = alpha sqrt(m_eff k a) v. That is our Hertz dashpot with d =
// alpha. The e that gives this alpha; none where it would lie outside [-0.5, 1].
std::optional<double> tsuji_restitution(double alpha);
double tsuji_damping(double restitution);  // that polynomial

}  // namespace grainreel
