// Carrying a tangential force along with a contact that turns.
#pragma once

#include <cmath>

#include "engine/base/vector.hpp"

namespace grainreel {

// Turns `force` (perpendicular to `before`) by the smallest rotation that takes unit normal `before` to `now`,
// then by `twist` (rad) about `now`; its length is kept. Projection alone, as in the original program, cannot
// see the twist. With c = before x now and d = before . now, Rodrigues' formula for f perpendicular to `before`
// is f d + c x f + c (c . f) / (1 + d).
inline Vec3 carry_along(const Vec3& force, const Vec3& before, const Vec3& now, double twist) {
    const double length_squared = force.squaredNorm();
    if (length_squared == 0) return force;
    const Vec3 axis = before.cross(now);
    const double cosine = before.dot(now);
    Vec3 turned = force * cosine + axis.cross(force) + axis * (axis.dot(force) / (1 + cosine));
    turned -= now * now.dot(turned);
    if (twist != 0) turned += now.cross(turned) * twist;  // the rescaling below makes it a rotation to O(twist^3)
    const double turned_squared = turned.squaredNorm();
    if (turned_squared == 0) return Vec3::Zero();
    return turned * std::sqrt(length_squared / turned_squared);
}

}  // namespace grainreel
