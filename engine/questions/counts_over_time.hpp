// How many grains are somewhere, or are like something, at every moment that a run kept.
#pragma once

#include <string>

#include "engine/questions/answer.hpp"
#include "engine/questions/asked_moment.hpp"

namespace grainreel {

// A row a moment: its time, the periods of the drive, the grains of each species for which `condition` holds,
// and all of them. Moments whose grains are damaged are left out, with a note. Throws UserError for what
// cannot be asked, and where the condition takes what a kept moment lacks.
Answer counts_over_time(const MomentFinder& finder, const Record& record, const std::string& condition);

}  // namespace grainreel
