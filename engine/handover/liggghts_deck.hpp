// The input script of LIGGGHTS for a scene. Written for LIGGGHTS-PUBLIC 3.8.0.
#pragma once

#include <string>

#include "engine/handover/carried_scene.hpp"

namespace grainreel {

// Atom types of its data file: those of grains, and one for each surface that they touch.
std::size_t liggghts_types(const CarriedScene& carried);

// Reads grains.data and walls/*.stl; writes liggghts.dump, outflow.txt where there is an outlet,
// liggghts.restart.STEP on its way, end.restart.
std::string liggghts_deck(const CarriedScene& carried);

}  // namespace grainreel
