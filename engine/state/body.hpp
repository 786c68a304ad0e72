// Rigid bodies, to which faces belong: the container, its floor, and each plane of the scene. No body turns
// yet. Frames and files have a rotation and a spin of each all the same. Drawing and faces move a body by its
// place alone, so both have to learn it when a body turns.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/drive_pose.hpp"

namespace grainreel {

// Where a body is and how it moves. At rest its origin is that of the scene.
struct BodyPose {
    Vec3 place{0, 0, 0};                           // m, of the body's origin
    Quaternion rotation = Quaternion::Identity();  // about that origin
    Vec3 velocity{0, 0, 0};                        // m/s, of the origin
    Vec3 spin{0, 0, 0};                            // rad/s

    bool operator==(const BodyPose& other) const {
        return place == other.place && rotation.coeffs() == other.rotation.coeffs() &&
               velocity == other.velocity && spin == other.spin;
    }
};

// The numbers of a scene's bodies: these two, whatever the container, then its planes in their order.
constexpr std::int32_t kContainerBody = 0, kFloorBody = 1, kFirstPlaneBody = 2;
// Of a tray, which stands still. It has no pose in files.
constexpr std::int32_t kTrayBody = -1;

// How a body moves: with the drive or not, and at a steady velocity on top of it.
struct Body {
    std::int32_t number = kContainerBody;
    bool driven = false;
    Vec3 velocity{0, 0, 0};  // m/s

    Vec3 place_at(const Pose& drive) const {
        return (driven ? drive.offset : Vec3(0, 0, 0)) + drive.time * velocity;
    }
    Vec3 velocity_at(const Pose& drive) const { return (driven ? drive.velocity : Vec3(0, 0, 0)) + velocity; }
    BodyPose at(const Pose& drive) const {
        return {place_at(drive), Quaternion::Identity(), velocity_at(drive), Vec3(0, 0, 0)};
    }
};

// All bodies of a scene, by number.
std::vector<Body> bodies_of(const Drive& drive, const std::vector<FreeWall>& planes);

// The poses of all bodies.
std::vector<BodyPose> poses_of(const std::vector<Body>& bodies, const Pose& drive);

// For a frame of an earlier version's file, which says where container and floor are at `time` (s): adds the
// poses of the planes, by the formula that moved them in the run.
void add_planes(const std::vector<FreeWall>& planes, double time, std::vector<BodyPose>& poses);

}  // namespace grainreel
