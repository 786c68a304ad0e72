// The input script of LAMMPS for a scene. Written for the version of 29 Sep 2021.
#pragma once

#include <string>

#include "engine/handover/carried_scene.hpp"

namespace grainreel {

// Reads grains.data; writes lammps.dump, end.restart.
std::string lammps_deck(const CarriedScene& carried);

}  // namespace grainreel
