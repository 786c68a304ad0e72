// Parts of carry(), for the files that make it up.
#pragma once

#include <string>

#include "engine/handover/carried_scene.hpp"
#include "engine/handover/carry.hpp"

namespace grainreel {

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

}  // namespace grainreel
