// Walls of other programs: surfaces that come once, or again at each moment where they are then. A surface
// that moves is one rigid body, whose shape is kept once and whose pose each moment has.
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
    std::vector<BodyPose> poses;  // one for each WallMoment; velocities are zero
    bool moves = false;
    std::vector<RawTable> cells;  // of each moment, a row a triangle; empty where there are none
};

// Connected parts of each surface, which may move on their own (LIGGGHTS writes all its meshes into one
// solid), each followed through all moments. unit: m. Where a surface changes its shape or its number of
// triangles, it stays as it was at first, with a line of news. name: of the files, for news.
std::vector<MovingWall> follow_walls(const std::vector<WallMoment>& moments, double unit,
                                     const std::string& name, std::vector<std::string>& news);

// The rotation and shift that bring points to where they are now, by least squares (Kabsch 1976, Acta Cryst.
// A 32, 922); residual: m, the largest distance that is left.
struct RigidMotion {
    BodyPose pose;
    double residual = 0;
};
RigidMotion rigid_motion(const std::vector<Vec3>& from, const std::vector<Vec3>& to);

}  // namespace grainreel
