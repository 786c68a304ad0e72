#include "engine/step/walls.hpp"

namespace grainreel {

void WallState::set(const std::vector<Face>& from, const Pose& before, const Pose& now, double step) {
    faces.resize(from.size());
    motion.resize(from.size());
    const Vec3 moving = step > 0 ? Vec3((now.offset - before.offset) / step) : now.velocity;
    for (std::size_t f = 0; f < from.size(); ++f) {
        const Vec3 point = from[f].moves ? Vec3(from[f].point + now.offset) : from[f].point;
        const bool plane = from[f].kind == Face::Kind::plane;
        const Vec3 normal = plane ? from[f].normal : Vec3::Zero();
        faces[f] = {normal, normal.dot(point), point, plane ? 0.0 : from[f].radius};
        const bool moves = from[f].moves;
        motion[f] = {moves ? moving : Vec3::Zero(), 0, moves ? now.velocity : Vec3::Zero(), 0};
    }
}

}  // namespace grainreel
