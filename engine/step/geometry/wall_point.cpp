#include "engine/step/geometry/wall_point.hpp"

namespace grainreel {

namespace {

// Writes numbers of contact c into the rows of a chunk.
struct Rows {
    int c;
    std::size_t size;  // bytes of a number

    void set(Row& row, double value) const { row.set(c, value, size); }
    void set(Row* rows, const Vec3& v) const {
        for (int a = 0; a < 3; ++a) rows[a].set(c, v[a], size);
    }
};

std::size_t number_size(const GeometryInput& in) {
    return in.rounded ? sizeof(float) : sizeof(double);
}

// Rounds a vector as the rows do. So there is no turn between two normals that are equal in the rows.
Vec3 as_held(const GeometryInput& in, const Vec3& v) {
    return in.rounded ? Vec3(v.cast<float>().cast<double>()) : v;
}

// Cayley's vector of the turn that takes the old normal to k, together with a turn about k by 2 `twist`:
// a + b + b x a, as in turn-inl.hpp, with a = k0 x k / (1 + k0 . k), whose length is the tangent of half the
// angle.
Vec3 turn_of(const Vec3& before, const Vec3& k, double twist) {
    const Vec3 a = before.cross(k) / (1 + before.dot(k)), b = twist * k;
    return a + b + b.cross(a);
}

}  // namespace

void set_apart(const GeometryInput& in, int c, TouchChunk& out) {
    out.overlap.set(c, -1, number_size(in));
}

void touch_point(const GeometryInput& in, int c, const WallPoint& point, TouchChunk& out) {
    const Rows rows{c, number_size(in)};
    const std::int32_t grain = in.first[c];
    const double radius = in.grains->place[grain].radius, overlap = radius - point.distance;
    rows.set(out.overlap, overlap);
    if (!(overlap > 0)) return;
    out.touching |= std::uint64_t{1} << c;
    const Vec3 k = as_held(in, point.normal);
    rows.set(out.normal, k);
    if (in.radius) rows.set(out.effective_radius, radius);

    const Motion& motion = in.grains->motion[grain];
    if (in.mass) rows.set(out.inverse_mass, motion.inverse_mass);
    if (in.wants == Wants::overlap) return;
    Vec3 velocity = motion.velocity - point.velocity;
    if (in.wants >= Wants::spin) {
        const double arm = in.arms == LeverArms::contact_plane ? point.distance : radius;
        const bool is_new = point.normal_before.isZero(0) || in.step == 0;
        const Vec3 before = is_new ? k : as_held(in, point.normal_before);
        // `change` leads from k to the normal at the step's middle, where velocities lag behind positions.
        const Vec3 change = in.turns_for > 0 ? Vec3(0.5 * (before - k)) : Vec3(0, 0, 0);
        const double twist = 0.25 * in.step * (motion.spin + point.spin).dot(k);
        rows.set(out.turn, turn_of(before, k, twist));
        velocity = velocity - change * k.dot(velocity) + (arm * motion.spin).cross(k + change);
        rows.set(out.first_arm, arm);
        if (in.wants == Wants::rolling) {
            const Vec3 rate = motion.spin - point.spin;
            rows.set(in.rolling->rate, rate - k * k.dot(rate));
        }
    }
    rows.set(out.velocity, velocity);
}

namespace {

// Copies that fill the last block do not touch.
void set_copies_apart(const GeometryInput& in, TouchChunk& out) {
    for (int c = in.count; c % kBlock != 0; ++c) set_apart(in, c, out);
}

// The point of a face that is nearest to the grain's centre. A cylinder turns about its own axis only.
WallPoint point_of(const GeometryInput& in, int c, const WallState& walls) {
    const FaceRecord& face = walls.faces[in.second[c]];
    const WallPose& pose = walls.poses[in.second[c]];
    const std::int32_t grain = in.first[c];
    const Vec3& centre = in.grains->place[grain].position;
    WallPoint point;
    if (face.radius > 0) {
        const Vec3 gone = in.step * in.grains->motion[grain].velocity;
        Vec3 out = centre - face.axis, out_before = centre - gone - pose.point_before;
        out.z() = out_before.z() = 0;
        const double rho = out.norm(), rho_before = out_before.norm();
        point.distance = face.radius - rho;
        point.normal = rho > 0 ? Vec3(out / rho) : Vec3(0, 0, 0);
        point.normal_before = rho_before > 0 ? Vec3(out_before / rho_before) : Vec3(0, 0, 0);
    } else {
        point.distance = face.normal.dot(centre) - face.level;
        point.normal = -face.normal;
        point.normal_before = -pose.normal_before;
    }
    point.velocity = pose.mean_velocity(pose.at_rest(centre + point.distance * point.normal));
    point.spin = pose.spin;
    return point;
}

}  // namespace

void touch_turning_walls(const GeometryInput& in, const WallState& walls, TouchChunk& out) {
    out.touching = 0;
    for (int c = 0; c < in.count; ++c) touch_point(in, c, point_of(in, c, walls), out);
    set_copies_apart(in, out);
}

}  // namespace grainreel
