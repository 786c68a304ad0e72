// Rigid bodies, to which faces and meshes belong: the container, its floor, each plane of the scene, each
// mesh.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Where the things are that the drive moves.

// Its displacement from rest and its velocity, both at the same time level.
struct Pose {
    Vec3 offset{0, 0, 0};    // m
    Vec3 velocity{0, 0, 0};  // m/s
    double time = 0;         // s, since the start of the motion
};

// Where a body is and how it moves. At rest its origin is that of the scene.
struct BodyPose {
    Vec3 place{0, 0, 0};                           // m, of the body's origin
    Quaternion rotation = Quaternion::Identity();  // about that origin
    Vec3 velocity{0, 0, 0};                        // m/s, of the origin
    Vec3 spin{0, 0, 0};                            // rad/s

    // From the place at rest to the place now, and back; m. A point that goes with the body.
    Vec3 moved(const Vec3& at_rest) const { return place + rotation * at_rest; }
    Vec3 at_rest(const Vec3& now) const { return rotation.conjugate() * (now - place); }
    Vec3 velocity_at(const Vec3& now) const { return velocity + spin.cross(now - place); }  // m/s

    bool operator==(const BodyPose& other) const {
        return place == other.place && rotation.coeffs() == other.rotation.coeffs() &&
               velocity == other.velocity && spin == other.spin;
    }
};

// The numbers of a scene's bodies: these two, whatever the container, then its planes in their order, then
// its meshes.
constexpr std::int32_t kContainerBody = 0, kFloorBody = 1, kFirstPlaneBody = 2;
// Number of a tray as a body. It stands still and has no pose in files.
constexpr std::int32_t kTrayBody = -1;

// How a body moves: with the drive or not, and by a motion of its own on top of it.
struct Body {
    std::int32_t number = kContainerBody;
    bool driven = false;
    Vec3 velocity{0, 0, 0};  // m/s
    std::optional<BodyTurn> turn = {};
    std::shared_ptr<const MotionPath> path = {};

    bool turns() const { return turn || (path && path->turns()); }
    bool has_own_motion() const { return turn || path; }  // beside a steady velocity
    BodyPose at(const Pose& drive) const;
    // Displacement and velocity of all points of a body that has no motion of its own but its velocity.
    Vec3 place_at(const Pose& drive) const {
        return (driven ? drive.offset : Vec3(0, 0, 0)) + drive.time * velocity;
    }
    Vec3 velocity_at(const Pose& drive) const { return (driven ? drive.velocity : Vec3(0, 0, 0)) + velocity; }
};

// All bodies of a scene, by number.
std::vector<Body> bodies_of(const Scene& scene);
// The container, its floor and these planes, without a turn of the container.
std::vector<Body> bodies_of(const Drive& drive, const std::vector<FreeWall>& planes);
inline std::int32_t first_mesh_body(const Scene& scene) {
    return kFirstPlaneBody + static_cast<std::int32_t>(scene.walls.size());
}

// The poses of all bodies.
std::vector<BodyPose> poses_of(const std::vector<Body>& bodies, const Pose& drive);

// For a frame of an earlier version's file, which says where container and floor are at `time` (s): adds the
// poses of the planes, by the formula that moved them in the run.
void add_planes(const std::vector<FreeWall>& planes, double time, std::vector<BodyPose>& poses);

}  // namespace grainreel
