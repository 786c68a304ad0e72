// The columns of measures.csv: their names there, and what to call them where people read.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/text/units.hpp"

namespace grainreel {

struct MeasureColumn {
    std::string name;   // "kinetic_J": the unit, when there is one, comes last
    std::string label;  // "kinetic energy"
    Dimension dimension = Dimension::number;
};

// species: their names, in the scene's order.
std::vector<MeasureColumn> measure_columns(const std::vector<std::string>& species);

}  // namespace grainreel
