// How many grains a file of VTK has, by its head alone: a long list of large files is opened without reading
// them.
#pragma once

#include "engine/files/foreign/vtk/vtk_parts.hpp"

namespace grainreel {

// Adds to the counts of a moment, and returns true, where the head says all: PolyData with appended numbers,
// in which each point is a vertex, or which is all polygons. Nothing is known then of how the file goes on.
// `time_known`: the list says the time, so that the file's own does not matter.
bool count_by_head(const VtkPartFile& part_file, bool time_known, VtkParts& parts);

}  // namespace grainreel
