// The contacts of a frame for VTK: lines with forces, and what they add up to on each grain.
#pragma once

#include <vector>

#include "engine/files/frames/world.hpp"
#include "engine/files/frames/writers/vtk_file.hpp"
#include "engine/frame.hpp"
#include "engine/state/contact_record.hpp"

namespace grainreel {

// A line from the first grain's centre to the second's, or to the point of contact on a wall. Across a
// periodic edge it ends at the image of the second one. Arrays of lines: normal_force (N, 0 or more),
// tangential_force and force (N, both on the second one), id1, id2 (of a wall -1 - its number), to_wall.
VtkPolyData contact_lines(const Frame& frame, const std::vector<ContactRecord>& contacts, const World& world);

// Where points and tangential forces are not known: lines between grains, with normal_force, id1, id2 and
// to_wall.
VtkPolyData contact_lines(const Frame& frame, const std::vector<Touch>& touches, const World& world);

// N, the sum of all contact forces on each grain.
std::vector<Vec3> forces_on_grains(const Frame& frame, const std::vector<ContactRecord>& contacts,
                                   const World& world);

}  // namespace grainreel
