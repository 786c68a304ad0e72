// One kind of contact in the words of LAMMPS' pair_style granular and its walls.
#pragma once

#include <string>

#include "engine/handover/carried_scene.hpp"

namespace grainreel {

// "hooke 9600 2647 tangential linear_history 2742 0 0.5 damping mass_velocity limit_damping"
std::string lammps_law(const CarriedPair& pair);

}  // namespace grainreel
