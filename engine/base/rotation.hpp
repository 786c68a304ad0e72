// Rotations: quaternions from an axis and an angle, and back. Eigen's AngleAxis, slerp and angularDistance
// call the C library's sines, whose bits differ between machines (mathematics.hpp).
#pragma once

#include <cmath>

#include "engine/base/mathematics.hpp"
#include "engine/base/vector.hpp"

namespace grainreel {

// The rotation by an angle (rad) about an axis of unit length, by the right-hand rule.
inline Quaternion rotation_about(const Vec3& axis, double angle) {
    const auto [sine, cosine] = math::sin_cos(0.5 * angle);
    return {cosine, sine * axis.x(), sine * axis.y(), sine * axis.z()};
}

// The axis of a rotation times its angle (rad), from 0 to pi.
inline Vec3 rotation_vector(const Quaternion& rotation) {
    const double sine = rotation.vec().norm();
    if (sine == 0) return Vec3::Zero();
    const double angle = 2 * math::atan2(sine, std::abs(rotation.w()));
    return (rotation.w() < 0 ? -angle : angle) / sine * rotation.vec();
}

// The angle of the rotation that leads from one to the other, 0 to pi.
inline double angle_between(const Quaternion& one, const Quaternion& other) {
    return rotation_vector(other * one.conjugate()).norm();
}

// Part of the way from one rotation to another, at a steady rate: share 0 is the first, 1 the second.
inline Quaternion rotation_between(const Quaternion& from, const Quaternion& to, double share) {
    const Vec3 turn = rotation_vector(to * from.conjugate());
    const double angle = turn.norm();
    return angle == 0 ? from : rotation_about(turn / angle, share * angle) * from;
}

}  // namespace grainreel
