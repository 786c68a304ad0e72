// The condition touches(...): whether a grain has a contact that carries force with what is named.
#pragma once

#include <string_view>
#include <vector>

#include "engine/questions/columns/grain_columns.hpp"

namespace grainreel {

// `who`: "wall" for any wall, a species, a wall or mesh as contacts name it ("left slant"), or a grain's id.
// Gives the number of a column beside grain_columns(), whose values are 1 and 0. Throws UserError for what is
// nothing of the scene, and where the snapshot's contacts are not known.
int touches_column(const Snapshot& snapshot, std::string_view who);

bool is_touches_column(int number);
// One for each grain of the list.
std::vector<double> values_of_touches(const Snapshot& snapshot, int number, const GrainList& grains);

}  // namespace grainreel
