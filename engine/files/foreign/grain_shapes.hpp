// Finds grains that are no spheres by the columns of their file, so that the user is told of them. A name
// that another program has for such a column is added in grain_shapes.cpp.
#pragma once

#include <string>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

// The names of the columns by which grains are ellipsoids or superquadrics; empty if all are spheres.
std::vector<std::string> columns_of_other_shapes(const RawTable& table);

}  // namespace grainreel
