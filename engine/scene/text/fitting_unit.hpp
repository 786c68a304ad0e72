// The unit that a number reads well in.
#pragma once

#include <string>

#include "engine/scene/text/units.hpp"

namespace grainreel {

// SI units in one of `unit`, 0.01 for "cm/s"; 1 for an empty one. Throws UserError, without a place, when it
// is not a unit of the dimension.
double unit_size(const std::string& unit, Dimension dimension);

// The largest of the dimension's usual units in which `value` is not below 0.5; the smallest of them for
// less.
std::string fitting_unit(double value, Dimension dimension);

}  // namespace grainreel
