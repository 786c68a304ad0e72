#include "engine/step/geometry/walls.hpp"

#include <algorithm>

namespace grainreel {

namespace {

FaceEnd end_of(const Face& face, const Vec3& offset) {
    const bool plane = face.kind == Face::Kind::plane;
    const double out_x = !plane || face.round_gap ? 1 : 0, out_y = !plane || face.gap > 0 ? 1 : 0;
    return {face.along, face.along.dot(face.edge + offset), out_x, out_y, face.gap, face.ends ? 1.0 : 0.0};
}

}  // namespace

void WallState::set(const std::vector<Face>& from, const Pose& before, const Pose& now, double step) {
    faces.resize(from.size());
    motion.resize(from.size());
    any_round = false;
    const bool any_ends = std::any_of(from.begin(), from.end(), [](const Face& face) { return face.ends; });
    ends.resize(any_ends ? from.size() : 0);
    for (std::size_t f = 0; f < from.size(); ++f) {
        const Vec3 there = from[f].displacement(now), velocity = from[f].velocity_at(now);
        const Vec3 point = from[f].point + there;
        const bool plane = from[f].kind == Face::Kind::plane;
        any_round |= !plane;
        const Vec3 normal = plane ? from[f].normal : Vec3::Zero();
        faces[f] = {normal, normal.dot(point), point, plane ? 0.0 : from[f].radius};
        const Vec3 mean = step > 0 ? Vec3((there - from[f].displacement(before)) / step) : velocity;
        motion[f] = {mean, 0, velocity, 0};
        if (any_ends) ends[f] = end_of(from[f], there);
    }
}

}  // namespace grainreel
