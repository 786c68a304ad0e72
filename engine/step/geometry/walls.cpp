#include "engine/step/geometry/walls.hpp"

#include <algorithm>

#include "engine/base/rotation.hpp"

namespace grainreel {

namespace {

FaceEnd end_of(const Face& face, const Vec3& offset) {
    const bool plane = face.kind == Face::Kind::plane;
    const double out_x = !plane || face.round_gap ? 1 : 0, out_y = !plane || face.gap > 0 ? 1 : 0;
    return {face.along, face.along.dot(face.edge + offset), out_x, out_y, face.gap, face.ends ? 1.0 : 0.0};
}

// Record of a face that has this normal and goes through `point` now.
FaceRecord record_of(const Face& face, const Vec3& its_normal, const Vec3& point) {
    const bool plane = face.kind == Face::Kind::plane;
    const Vec3 normal = plane ? its_normal : Vec3::Zero();
    return {normal, normal.dot(point), point, plane ? 0.0 : face.radius};
}

FaceMotion motion_of(const Vec3& gone, double step, const Vec3& velocity) {
    return {step > 0 ? Vec3(gone / step) : velocity, 0, velocity, 0};
}

}  // namespace

void WallPose::set(const Body& body, const Vec3& rest_point, const DrivePose& before_drive,
                   const DrivePose& now_drive, double step) {
    const BodyPose before = body.at(before_drive);
    now = body.at(now_drive);
    turned = now.rotation.toRotationMatrix();
    point = now.moved(rest_point);
    if (step > 0) {
        moved = (now.place - before.place) / step;
        rate = (turned - before.rotation.toRotationMatrix()) / step;
        spin = rotation_vector(now.rotation * before.rotation.conjugate()) / step;
    } else {
        moved = now.velocity;
        for (int a = 0; a < 3; ++a) rate.col(a) = now.spin.cross(turned.col(a));
        spin = now.spin;
    }
    slides = turned.isIdentity(0) && rate.isZero(0);
}

void WallState::set(const Surroundings& around, const DrivePose& before, const DrivePose& now, double step) {
    set(around.faces, before, now, step);
    if (!turning && around.meshes.empty()) return;
    poses.resize(around.faces.size() + around.meshes.size());
    for (std::size_t f = 0; turning && f < around.faces.size(); ++f) {
        const Face& face = around.faces[f];
        const BodyPose was = face.body.at(before);
        poses[f].set(face.body, moment_point(face), before, now, step);
        poses[f].point_before = was.moved(face.point);
        poses[f].normal_before = was.rotation * face.normal;
    }
    for (std::size_t m = 0; m < around.meshes.size(); ++m)
        poses[around.faces.size() + m].set(around.meshes[m].body, around.meshes[m].point, before, now, step);
}

void WallState::set(const std::vector<Face>& from, const DrivePose& before, const DrivePose& now,
                    double step) {
    faces.resize(from.size());
    motion.resize(from.size());
    any_round = turning = false;
    const bool any_ends = std::any_of(from.begin(), from.end(), [](const Face& face) { return face.ends; });
    ends.resize(any_ends ? from.size() : 0);
    for (std::size_t f = 0; f < from.size(); ++f) {
        any_round |= from[f].kind != Face::Kind::plane;
        if (from[f].body.has_own_motion()) {
            turning = true;
            const BodyPose was = from[f].body.at(before), is = from[f].body.at(now);
            const Vec3 point = is.moved(from[f].point);
            faces[f] = record_of(from[f], is.rotation * from[f].normal, point);
            motion[f] = motion_of(point - was.moved(from[f].point), step, is.velocity_at(point));
            continue;
        }
        const Vec3 there = from[f].displacement(now);
        faces[f] = record_of(from[f], from[f].normal, from[f].point + there);
        motion[f] = motion_of(there - from[f].displacement(before), step, from[f].velocity_at(now));
        if (any_ends) ends[f] = end_of(from[f], there);
    }
}

}  // namespace grainreel
