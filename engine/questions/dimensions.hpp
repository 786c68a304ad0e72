// Dimensions of numbers in words.
#pragma once

#include <string>

#include "engine/scene/text/units.hpp"

namespace grainreel {

Powers powers_of(Dimension dimension);
bool same_powers(const Powers& a, const Powers& b);
bool is_plain(const Powers& powers);  // of a number without a unit
// "a length"; "a number in m2.s-1" for what has no name here.
std::string noun_of_powers(const Powers& powers);

}  // namespace grainreel
