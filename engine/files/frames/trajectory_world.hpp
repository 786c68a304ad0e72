// What a trajectory's file says of its world, and what a writer of one takes from a world.
#pragma once

#include <string>
#include <vector>

#include "engine/files/frames/frame_archive.hpp"
#include "engine/files/frames/world.hpp"
#include "engine/files/trajectory.hpp"

namespace grainreel {

World world_of(const TrajectoryInfo& info);
TrajectoryInfo trajectory_info(const World& world, const FrameSupply& supply);

// Frames that are not whole, and those that the file's header does not count; a sentence each. name: the
// file's.
std::vector<std::string> faults_of(const TrajectoryReader& trajectory, const std::string& name);

}  // namespace grainreel
