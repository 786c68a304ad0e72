// Rigid bodies, to which faces and meshes belong. The bodies are the container, its floor, each plane of the
// scene and each mesh.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// The position of everything that the drive moves.

// Displacement from rest and velocity of the drive, both at the same time level.
struct Pose {
    Vec3 offset{0, 0, 0};    // m
    Vec3 velocity{0, 0, 0};  // m/s
    double time = 0;         // s, since the start of the motion
};

// Position and motion of a body. At rest its origin is the origin of the scene.
struct BodyPose {
    Vec3 place{0, 0, 0};                           // m, of the body's origin
    Quaternion rotation = Quaternion::Identity();  // about that origin
    Vec3 velocity{0, 0, 0};                        // m/s, of the origin
    Vec3 spin{0, 0, 0};                            // rad/s

    // moved() takes a point of the body (m) from its place at rest to its place now, and at_rest() takes it
    // back.
    Vec3 moved(const Vec3& at_rest) const { return place + rotation * at_rest; }
    Vec3 at_rest(const Vec3& now) const { return rotation.conjugate() * (now - place); }
    Vec3 velocity_at(const Vec3& now) const { return velocity + spin.cross(now - place); }  // m/s

    bool operator==(const BodyPose& other) const {
        return place == other.place && rotation.coeffs() == other.rotation.coeffs() &&
               velocity == other.velocity && spin == other.spin;
    }
};

// The numbers of a scene's bodies: container and floor, whatever the shape of the container, then the planes
// in their order, then the meshes.
constexpr std::int32_t kContainerBody = 0, kFloorBody = 1, kFirstPlaneBody = 2;
// Number of a tray as a body. It stands still and has no pose in files.
constexpr std::int32_t kTrayBody = -1;

// The motion of a body: with the drive or not, and by a motion of its own on top of it.
struct Body {
    std::int32_t number = kContainerBody;
    bool driven = false;
    Vec3 velocity{0, 0, 0};  // m/s
    std::optional<BodyTurn> turn = {};
    std::shared_ptr<const MotionPath> path = {};

    bool turns() const { return turn || (path && path->turns()); }
    bool has_own_motion() const { return turn || path; }  // a motion other than a steady velocity
    BodyPose at(const Pose& drive) const;
    // Displacement and velocity of all points of a body that has no motion of its own except a steady
    // velocity.
    Vec3 place_at(const Pose& drive) const {
        return (driven ? drive.offset : Vec3(0, 0, 0)) + drive.time * velocity;
    }
    Vec3 velocity_at(const Pose& drive) const { return (driven ? drive.velocity : Vec3(0, 0, 0)) + velocity; }
};

// All bodies of a scene, by number.
std::vector<Body> bodies_of(const Scene& scene);
// The bodies of a container that does not turn, its floor and these planes.
std::vector<Body> bodies_of(const Drive& drive, const std::vector<FreeWall>& planes);
inline std::int32_t first_mesh_body(const Scene& scene) {
    return kFirstPlaneBody + static_cast<std::int32_t>(scene.walls.size());
}

// The poses of all bodies.
std::vector<BodyPose> poses_of(const std::vector<Body>& bodies, const Pose& drive);

// Adds the poses of the planes at `time` (s), by the formula that moved them in the run. Frames in files of
// an earlier version hold only the poses of container and floor.
void add_planes(const std::vector<FreeWall>& planes, double time, std::vector<BodyPose>& poses);

}  // namespace grainreel
