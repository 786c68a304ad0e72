// The walls over one step, as the vector code reads them.
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
    Vec3 axis;      // m, a point on a cylinder's axis
    double radius;  // m, of a cylinder; 0 for a plane
};

// Where a face ends; see Face. A face that does not end has no edge, no gap and two_sided = 0.
struct alignas(64) FaceEnd {
    Vec3 along;           // unit, across the lower edge; zero for none
    double level;         // m, along . a point of the edge
    double out_x, out_y;  // 1 where this coordinate counts for the distance from the axis or from the gap
    double gap;           // m
    double two_sided;     // 1 for a face that ends
};

// The velocity of every point of the face. Where a body turns, WallPose has those of its points.
struct alignas(64) FaceMotion {
    Vec3 velocity;  // m/s, mean over the step
    double unused_one;
    Vec3 at_end;  // m/s
    double unused_two;
};

// m, at rest: the point about which a face's moment counts. It stays where it is while the body turns.
inline Vec3 moment_point(const Face& face) {
    return face.body.turn ? face.body.turn->through : face.point;
}

// A wall whose points move in different ways, over one step.
struct WallPose {
    BodyPose now;
    Eigen::Matrix3d turned;       // now, from rest
    Vec3 moved{0, 0, 0};          // m/s, mean velocity of the body's origin
    Eigen::Matrix3d rate;         // 1/s, mean, by which `turned` grows
    Vec3 spin{0, 0, 0};           // rad/s, mean over the step
    Vec3 point{0, 0, 0};          // m, now: about which the moment counts; of a face that turns on its axis
    Vec3 point_before{0, 0, 0};   // m, of a face: its point a step ago
    Vec3 normal_before{0, 0, 0};  // of a face: its normal a step ago
    bool slides = false;          // it stands as at rest and does not turn: its points all move alike

    // From `before` to `now` within `step` seconds; rest_point: m, that `point` is at rest.
    void set(const Body& body, const Vec3& rest_point, const Pose& before, const Pose& now, double step);
    // m/s, of a point that is given in the body's frame: its way in the step over the step.
    Vec3 mean_velocity(const Vec3& at_rest) const { return slides ? moved : Vec3(moved + rate * at_rest); }
    // From the scene to the body's frame, m; and directions the other way.
    Vec3 at_rest(const Vec3& place) const {
        const Vec3 from = place - now.place;
        return slides ? unturned(from) : Vec3(turned.transpose() * from);
    }
    Vec3 turned_out(const Vec3& direction) const {
        return slides ? unturned(direction) : Vec3(turned * direction);
    }

  private:
    // As the product with the identity gives it, which has no zeros below zero.
    static Vec3 unturned(const Vec3& v) { return v + Vec3(0, 0, 0); }
};

struct WallState {
    std::vector<FaceRecord> faces;  // where they are at the step's end
    std::vector<FaceMotion> motion;
    std::vector<FaceEnd> ends;    // empty where no face ends
    std::vector<WallPose> poses;  // of all faces and, behind them, meshes; empty where nothing needs them
    bool any_round = false;       // a cylinder among the faces
    bool turning = false;         // a face among them whose body turns
    WallTally* tally = nullptr;   // sums up what grains do to the walls, where somebody wants to know

    // From `before` to `now` within `step` seconds; without a step the velocity is that of `now`.
    void set(const Surroundings& around, const Pose& before, const Pose& now, double step);
    void set(const std::vector<Face>& from, const Pose& before, const Pose& now, double step);
    const WallPose& pose_of_mesh(std::int32_t mesh) const {
        return poses[faces.size() + static_cast<std::size_t>(mesh)];
    }
};

}  // namespace grainreel
