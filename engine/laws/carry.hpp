// Carrying a tangential force along with a contact that turns.
#pragma once

#include <cmath>

#include "engine/base/vector.hpp"

namespace grainreel {

// Turns `force` (perpendicular to `before`) by the smallest rotation that takes unit normal `before` to
// `now`, then by `twist` (rad) about `now`; its length is kept. Projection alone, as in the original program,
// cannot see the twist. With c = before x now and d = before . now, Rodrigues' formula for f perpendicular to
// `before` is f d + c x f + c (c . f) / (1 + d). The twist is Cayley's rotation by 2 atan(twist / 2): exact
// in length, and in angle to twist^3 / 12.
inline Vec3 carry_along(const Vec3& force, const Vec3& before, const Vec3& now, double twist) {
    if (force.x() == 0 && force.y() == 0 && force.z() == 0) return force;
    const Vec3 axis = before.cross(now);
    const double cosine = before.dot(now);
    Vec3 turned = force * cosine + axis.cross(force) + axis * (axis.dot(force) / (1 + cosine));
    turned -= now * now.dot(turned);  // what round-off left along the normal
    const double t = 0.5 * twist;
    const double scale = 1 / (1 + t * t);
    return turned * ((1 - t * t) * scale) + now.cross(turned) * (2 * t * scale);
}

}  // namespace grainreel
