// carry() makes a CarriedScene from a scene and its plan: which laws, contacts, walls, drive and times the
// other engine gets, and what is changed or refused. carry.cpp has the run and the walls, carry_contacts.cpp
// the laws and contacts.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/handover/carried_scene.hpp"

namespace grainreel {

struct CarryRequest {
    PeerEngine engine = PeerEngine::lammps;
    int ranks = 1;
    bool accept_law = false;  // a law that the engine does not have may become the nearest one that it has
    bool edinburgh = false;   // for LIGGGHTS on one rank: Walton-Braun stays as it is
    // With more grains than this the deck packs them itself.
    std::int64_t packs_above = 1'000'000;
    // Options of the verb in use, for messages: the one that names the engine, and the one of packs_above.
    std::string engine_option = "--to", pack_option = "--pack-there";
    // Steps at which the engine writes a dump, as we count; if empty, those of the trajectory.
    std::vector<std::int64_t> dumps{};
};

// What cannot be carried is listed in `refusals`; then only changes, engine and scene can be used. Throws
// UserError only where the scene with its new law has no plan.
CarriedScene carry(const Scene& scene, const Plan& plan, const CarryRequest& request);

// Returns if nothing is refused. Otherwise tells all refusals but the last one, and throws UserError with the
// last one. A refusal reads "file:line:column: what is wrong".
void throw_refusals(const CarriedScene& carried, const std::function<void(const std::string&)>& tell);

// The parts of carry(). Only its two sources call them.

void add_change(CarriedScene& carried, const std::string& where, const std::string& what,
                const std::string& why);
void add_refusal(CarriedScene& carried, const std::string& where, const std::string& what);

// Replaces the laws of carried.scene by those that the engine has, and lists what that changes, or refuses it
// if it was not asked for. plan: that of the scene with its own laws.
void carry_laws(const CarryRequest& request, const Plan& plan, CarriedScene& carried);
// Takes the numbers of all contacts from carried.plan.
void carry_contacts(const CarryRequest& request, CarriedScene& carried);
// Sets walls, frame and drive.
void carry_walls(CarriedScene& carried);
// Sets which grains come and go, how grains begin, and what is written.
void carry_run(const CarryRequest& request, CarriedScene& carried);

// The restitution e that LAMMPS must be told for our Hertz dashpot. Its `damping tsuji` computes
//   alpha = 1.2728 - 4.2783 e + 11.087 e^2 - 22.348 e^3 + 27.467 e^4 - 18.022 e^5 + 4.8218 e^6
// (manual, pair_style granular) and N_d = alpha sqrt(m_eff k a) v, which is our dashpot with d = alpha. This
// function finds the e in [-0.5, 1] that gives alpha. It returns 1 where e would be larger, and none where e
// would be smaller than -0.5.
std::optional<double> tsuji_restitution(double alpha);
double tsuji_damping(double restitution);  // the polynomial

}  // namespace grainreel
