// The forces of one step: new contacts, then each contact's geometry, law and load.
#pragma once

#include "engine/step/forces/law_input.hpp"
#include "engine/step/forces/vanguard.hpp"
#include "engine/step/lists/thread_contacts.hpp"
#include "engine/step/threads/cost_clock.hpp"

namespace grainreel {

// Adds the forces of walls, then those of pairs, to the loads of the thread's own grains, and the work of
// moving walls to their accounts. `grains` are those of `in`. Grains of `vanguard` begin their next step as
// soon as their loads are complete.
void add_contact_forces(const ForceInput& in, Grains& grains, ThreadContacts& contacts, ChunkMemory& memory,
                        Vanguard& vanguard, CostClock& clock);

}  // namespace grainreel
