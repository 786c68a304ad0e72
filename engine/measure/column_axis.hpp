// What axis a column of measures.csv takes where it is drawn.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene.hpp"

namespace grainreel {

struct ColumnAxis {
    bool from_zero = false;  // it cannot be negative: the axis begins at 0
    double expected = 0;     // SI, about how large it gets, by the scene; 0 where nobody knows
};

ColumnAxis axis_of_column(const Scene& scene, const std::string& column);

// Columns that cannot be negative, but for those that have a species' name.
const std::vector<std::string>& columns_from_zero();

}  // namespace grainreel
