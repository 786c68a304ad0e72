// The rows of a path's file, checked one by one. Internal to MotionPath.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

struct PathRows {
    std::vector<int> lines;  // of the file, from 1
    std::vector<double> times;
    std::vector<Vec3> places;
    std::vector<Eigen::Vector4d> turns;  // unit, w first, each on the side of the one before; or none at all
};

// Throws UserError as MotionPath::read does.
PathRows read_path_rows(const std::filesystem::path& file);

}  // namespace grainreel
