// What the reader of quantities asks of a system of units: udunits2 (unit_system.cpp), or, in a page, the few
// units that occur in a scene whose values are resolved (engine/web/few_units.cpp).
#pragma once

#include <optional>
#include <string>

namespace grainreel::unit_system {

// All of these are safe from several threads. They throw UserError if the system has no table of units.

bool knows(const std::string& unit);
// The factor from one unit to another; none when one of them is unknown, or they measure different things.
// The radian is a dimension of its own, so that 25 rad/s is not 25 Hz.
std::optional<double> factor(const std::string& from, const std::string& to);
// A unit in base units, without its factor: "m.kg.s-2", empty for a pure number, "none" where it has none.
// Nothing for text that is no unit.
std::optional<std::string> base_units(const std::string& unit);

}  // namespace grainreel::unit_system
