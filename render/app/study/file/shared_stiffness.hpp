// One material for all members of a study. The plan chooses the stiffness of contacts by the drive, the bed's
// height and the grains, so members that differ in these would be of different materials.
#pragma once

#include <string>

#include "render/app/study/study.hpp"

namespace grainreel {

// Plans all settings. If the plan's stiffness differs between them, each kind of contact gets the largest one
// for all, as [[contact.pair]] at the end of the study's copy of the scene. Nothing is changed where the
// study says stiffness = "own", where it varies what decides the stiffness itself (run.overlap, run.accuracy,
// a key of [contact] for it), or where the scene gives the stiffness.
//
// Returns what is to be told, one sentence without a full stop; empty where nothing differs. Throws UserError
// for a setting that cannot be planned.
std::string share_stiffness(Study& study);

}  // namespace grainreel
