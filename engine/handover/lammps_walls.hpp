// Faces of a scene as regions of LAMMPS. Internal to its deck.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/handover/carried_scene.hpp"

namespace grainreel {

struct LammpsRegion {
    std::string name;                    // "floor", "left_slant"; a floor with a slot is two: "floor_0"
    std::string text;                    // the whole command
    std::vector<std::string> variables;  // commands before it
};

// The regions of the faces as the run begins, or after the outlet has opened. Names of faces that the outlet
// has changed end in "_open".
std::vector<LammpsRegion> lammps_regions(const CarriedScene& carried, bool opened);

// Where grains leave the run: those of the scene's exits and below its outlet.
std::vector<LammpsRegion> lammps_exits(const CarriedScene& carried);

}  // namespace grainreel
