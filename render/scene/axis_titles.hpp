// Titles of axes and legends, and the units that labels of the user's own say.
#pragma once

#include <string>

#include "engine/scene/text/units.hpp"

namespace grainreel {

// "mass (g)"; the words alone without a unit.
std::string with_unit(const std::string& words, const std::string& unit);

// A label may say its unit at its end: "sand (g)", "sand [g]", "sand, g" and "sand in g" of a mass.
struct LabelParts {
    std::string words;  // "sand"; the whole label where it says no unit of the dimension
    std::string unit;   // "g"
};
LabelParts label_parts(const std::string& label, Dimension dimension);

// The title with this unit, in place of one that the words say.
std::string with_unit(const std::string& words, const std::string& unit, Dimension dimension);

}  // namespace grainreel
