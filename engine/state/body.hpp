// Rigid bodies, whose surfaces are faces and meshes, and how each of them moves. The bodies are the
// container, its floor, each plane of the scene, each mesh, and a tray that never moves.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/motion.hpp"
#include "engine/state/pose.hpp"

namespace grainreel {

struct Drive;       // engine/scene/scene.hpp
struct ScenePlane;  // there too
struct Scene;       // there too

// Displacement from rest, and velocity, of everything that the drive moves, at one time.
struct DrivePose {
    Vec3 offset{0, 0, 0};    // m
    Vec3 velocity{0, 0, 0};  // m/s
    double time = 0;         // s, since the start of the motion
};

// How a body moves: with the drive if `driven`, and on top of that by a steady velocity, a turn or a path of
// its own.
struct Body {
    std::int32_t number = kContainerBody;
    bool driven = false;
    Vec3 velocity{0, 0, 0};  // m/s
    std::optional<BodyTurn> turn = {};
    std::shared_ptr<const MotionPath> path = {};

    bool turns() const { return turn || (path && path->turns()); }
    bool has_own_motion() const { return turn || path; }  // a turn or a path
    BodyPose at(const DrivePose& drive) const;
    // Displacement and velocity by drive and steady velocity. They hold for all points of the body if
    // has_own_motion() is false.
    Vec3 place_at(const DrivePose& drive) const {
        return (driven ? drive.offset : Vec3(0, 0, 0)) + drive.time * velocity;
    }
    Vec3 velocity_at(const DrivePose& drive) const {
        return (driven ? drive.velocity : Vec3(0, 0, 0)) + velocity;
    }
};

// All bodies of a scene, by number.
std::vector<Body> bodies_of(const Scene& scene);
// The bodies of a container that does not turn, of its floor and of these planes.
std::vector<Body> bodies_of(const Drive& drive, const std::vector<ScenePlane>& planes);
std::int32_t first_mesh_body(const Scene& scene);

// The poses of all bodies.
std::vector<BodyPose> poses_of(const std::vector<Body>& bodies, const DrivePose& drive);

// For frames of files of an earlier version, which hold only container and floor: adds the poses of the
// planes at `time` (s), by the formula that moved them in the run.
void add_planes(const std::vector<ScenePlane>& planes, double time, std::vector<BodyPose>& poses);

}  // namespace grainreel
