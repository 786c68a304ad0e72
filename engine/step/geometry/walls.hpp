// The state of the walls over one step, in the form that the vector code reads. It reads the aligned records
// by offset, so their members must keep their order.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/state/container_faces.hpp"
#include "engine/step/geometry/wall_sums.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

struct alignas(64) FaceRecord {
    Vec3 normal;    // unit, into the container; zero for a cylinder
    double level;   // m, normal . point
    Vec3 axis;      // m, a point on a cylinder's axis; for a plane, Face::point, about which its gap lies
    double radius;  // m, of a cylinder; 0 for a plane
};

// The ends of a face; see Face. A face that does not end has no edge, no gap and two_sided = 0.
struct alignas(64) FaceEnd {
    Vec3 along;    // unit, as Face::along; zero without an edge
    double level;  // m, along . a point of the edge
    // A cylinder and a gap need the distance from FaceRecord::axis. Each of these is 1 if x or y is part of
    // that distance, else 0: both for a cylinder and a round hole, only y for a slot along x.
    double out_x, out_y;
    double gap;        // m
    double two_sided;  // 1 for a face that ends
};

// The velocity of every point of the face. Where a body turns, its points differ, and WallPose gives their
// velocities.
struct alignas(64) FaceMotion {
    Vec3 velocity;  // m/s, mean over the step
    double unused_one;
    Vec3 at_end;  // m/s
    double unused_two;
};

// The point (m, at rest) about which the moment of the forces on a face is taken. If the body turns, this
// point lies on the axis, so the turn does not move it.
inline Vec3 moment_point(const Face& face) {
    return face.body.turn ? face.body.turn->through : face.point;
}

// A wall whose points move in different ways, over one step.
struct WallPose {
    BodyPose now;
    Eigen::Matrix3d turned;       // the rotation from rest to now
    Vec3 moved{0, 0, 0};          // m/s, mean velocity of the body's origin
    Eigen::Matrix3d rate;         // 1/s, mean rate of change of `turned`
    Vec3 spin{0, 0, 0};           // rad/s, mean over the step
    Vec3 point{0, 0, 0};          // m, now; moments are taken about it; on the axis for a face that turns
    Vec3 point_before{0, 0, 0};   // m, point of the face a step ago
    Vec3 normal_before{0, 0, 0};  // normal of the face a step ago
    bool slides =
        false;  // true if the wall has not turned and does not turn, so that all its points move alike

    // Sets the pose of a wall that moves from `before` to `now` within `step` seconds. `rest_point` (m) is
    // `point` at rest.
    void set(const Body& body, const Vec3& rest_point, const DrivePose& before, const DrivePose& now,
             double step);
    // Velocity (m/s) of a point given in the body's frame: its displacement in the step, divided by the step.
    Vec3 mean_velocity(const Vec3& at_rest) const { return slides ? moved : Vec3(moved + rate * at_rest); }
    // Takes a place (m) from the scene to the body's frame.
    Vec3 at_rest(const Vec3& place) const {
        const Vec3 from = place - now.place;
        return slides ? unturned(from) : Vec3(turned.transpose() * from);
    }
    Vec3 turned_out(const Vec3& direction) const {
        return slides ? unturned(direction) : Vec3(turned * direction);
    }

  private:
    // Gives the same bits as a product with the identity matrix, which never gives a negative zero.
    static Vec3 unturned(const Vec3& v) { return v + Vec3(0, 0, 0); }
};

struct WallState {
    std::vector<FaceRecord> faces;  // at the step's end
    std::vector<FaceMotion> motion;
    std::vector<FaceEnd> ends;    // empty where no face ends
    std::vector<WallPose> poses;  // poses of all faces, then those of all meshes; empty if nothing needs them
    bool any_round = false;       // whether a cylinder is among the faces
    bool turning = false;         // whether the body of a face turns
    WallTally* tally = nullptr;   // sums the forces on the walls; nullptr if nobody asks for them

    // Sets walls that move from `before` to `now` within `step` seconds. If `step` is 0, the velocity is that
    // of `now`.
    void set(const Surroundings& around, const DrivePose& before, const DrivePose& now, double step);
    void set(const std::vector<Face>& from, const DrivePose& before, const DrivePose& now, double step);
    const WallPose& pose_of_mesh(std::int32_t mesh) const {
        return poses[faces.size() + static_cast<std::size_t>(mesh)];
    }
};

}  // namespace grainreel
