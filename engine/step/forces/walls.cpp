#include "engine/step/forces/walls.hpp"

namespace grainreel {

void WallState::set(const std::vector<Face>& from, const Pose& before, const Pose& now, double step) {
    faces.resize(from.size());
    motion.resize(from.size());
    any_round = false;
    for (std::size_t f = 0; f < from.size(); ++f) {
        const Vec3 there = from[f].displacement(now), velocity = from[f].velocity_at(now);
        const Vec3 point = from[f].point + there;
        const bool plane = from[f].kind == Face::Kind::plane;
        any_round |= !plane;
        const Vec3 normal = plane ? from[f].normal : Vec3::Zero();
        faces[f] = {normal, normal.dot(point), point, plane ? 0.0 : from[f].radius};
        const Vec3 mean = step > 0 ? Vec3((there - from[f].displacement(before)) / step) : velocity;
        motion[f] = {mean, 0, velocity, 0};
    }
}

}  // namespace grainreel
