// Titles of axes and legends, and the units that labels of the user's own say: for plots in films, charts of
// studies and the page.
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

// What an axis is called: "drive frequency (Hz)". The unit is left out where there is none, and where the
// label names it by itself: "rate of the drum, rad/s".
std::string axis_title(const std::string& label, const std::string& unit);

// The unit in which the numbers of an axis are shown: that which its label says, if it is another one of the
// same kind ("energy (mJ)", "height in mm"), else `unit`. Numbers are multiplied by `factor`.
struct ShownUnit {
    std::string unit;
    double factor = 1;
};
ShownUnit shown_unit(const std::string& label, const std::string& unit);

}  // namespace grainreel
