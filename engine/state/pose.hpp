// BodyPose is where a body is and how it moves; frames have one for each body. Also here: the numbers of the
// bodies. Keep this header light: whatever looks at frames includes it.
#pragma once

#include <cstdint>

#include "engine/base/vector.hpp"

namespace grainreel {

// Position and motion of a body. "At rest" means before anything moves. The origin of each body is then the
// origin of the scene.
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
// The number of the tray, which catches what flows out of an outlet. The tray stands still and has no pose in
// files.
constexpr std::int32_t kTrayBody = -1;

}  // namespace grainreel
