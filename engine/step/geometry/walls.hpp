// The walls over one step, as the vector code reads them.
#pragma once

#include <vector>

#include "engine/state/container_faces.hpp"
#include "engine/step/geometry/wall_sums.hpp"

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

// The velocity of every point of the face, because no body turns. When a body turns, its spin will stand here
// too, and touch_walls() (wall_geometry.cpp) will add spin x arm.
struct alignas(64) FaceMotion {
    Vec3 velocity;  // m/s, mean over the step
    double unused_one;
    Vec3 at_end;  // m/s
    double unused_two;
};

struct WallState {
    std::vector<FaceRecord> faces;  // where they are at the step's end
    std::vector<FaceMotion> motion;
    std::vector<FaceEnd> ends;   // empty where no face ends
    bool any_round = false;      // a cylinder among them
    WallTally* tally = nullptr;  // sums up what grains do to the faces, where somebody wants to know

    // From `before` to `now` within `step` seconds; without a step the velocity is that of `now`.
    void set(const std::vector<Face>& from, const Pose& before, const Pose& now, double step);
};

}  // namespace grainreel
