// Walls of other programs. A file has a surface once, or again at each moment in its present place. Here a
// surface that moves becomes a rigid body: its shape is kept once, and each moment has its pose.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/state/body.hpp"

namespace grainreel {

// A wall at one moment.
struct WallMoment {
    std::optional<std::int64_t> step{};
    std::optional<double> time{};
    std::vector<RawWall> walls;
};

struct MovingWall {
    std::string name;
    TriangleMesh shape;           // m, as it was at its first moment
    std::vector<BodyPose> poses;  // one for each WallMoment, with zero velocities
    bool moves = false;
    std::vector<RawTable> cells;  // for each moment a row for each triangle; empty where there are none
};

// Follows the connected parts of each surface through all moments. Parts may move on their own, because
// LIGGGHTS writes all its meshes into one solid. A surface that changes its shape or its number of triangles
// stays as it was at first, with a line of news. unit: m. name: of the files, for news.
std::vector<MovingWall> follow_walls(const std::vector<WallMoment>& moments, double unit,
                                     const std::string& name, std::vector<std::string>& news);

// The rotation and displacement that move points to their present places, by least squares (Kabsch 1976, Acta
// Cryst. A 32, 922). residual: m, the largest distance that remains.
struct RigidMotion {
    BodyPose pose;
    double residual = 0;
};
RigidMotion rigid_motion(const std::vector<Vec3>& from, const std::vector<Vec3>& to);

}  // namespace grainreel
