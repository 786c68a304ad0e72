// Contacts of grains with points of walls that move in different ways: with meshes, and with faces of bodies
// that turn. They are computed one by one, in doubles. Walls whose points all move alike are computed by the
// vector code of wall_geometry.cpp.
//
// The time levels are those of turn-inl.hpp: overlap and normal belong to the step's end, velocities and turn
// to the whole step. The wall's velocity is the displacement of its material point in the step, divided by
// the step. The old normal is known. So a grain that turns with its wall as one body does not slip.
#pragma once

#include <cstddef>

#include "engine/step/geometry/contact_geometry.hpp"

namespace grainreel {

// The point of a wall that is nearest to a grain's centre.
struct WallPoint {
    Vec3 normal{0, 0, 0};         // unit, from the grain's centre to the point; unset where they do not touch
    Vec3 normal_before{0, 0, 0};  // a step ago; zero where they did not touch then
    double distance = 0;          // m, of the centre
    Vec3 velocity{0, 0, 0};       // m/s, of the wall's point, mean over the step
    Vec3 spin{0, 0, 0};           // rad/s, of the wall, mean over the step
};

// Fills the rows of contact c that `in` asks for, and sets its bit in `touching` if it touches. Before the
// first contact of a chunk, `touching` must be 0. set_apart() is for a contact that does not touch.
void touch_point(const GeometryInput& in, int c, const WallPoint& point, TouchChunk& out);
void set_apart(const GeometryInput& in, int c, TouchChunk& out);

// Does what touch_walls() does, where the body of a face turns. No face may end.
void touch_turning_walls(const GeometryInput& in, const WallState& walls, TouchChunk& out);

// A place at which a grain touches a mesh, as found in this step. The vector code loads it four numbers at a
// time, so its members must keep their order.
struct alignas(64) MeshTouch {
    static constexpr double kApart = 1e300;
    // The doubles with which its bundles of four begin, and their number.
    enum Part { kNormal = 0, kNormalBefore = 4, kVelocity = 8, kSpin = 12, kNumbers = 16 };

    Vec3 normal{0, 0, 0};         // unit, from the grain's centre to the place
    double distance = kApart;     // m, of the centre; kApart: does not touch
    Vec3 normal_before{0, 0, 0};  // as the contact remembers it; zero for a new contact
    double triangle = 0;          // its number
    Vec3 velocity{0, 0, 0};       // m/s, of the surface there, mean over the step
    double unused_one = 0;
    Vec3 spin{0, 0, 0};  // rad/s, of the surface, mean over the step
    double unused_two = 0;
};
static_assert(sizeof(MeshTouch) == MeshTouch::kNumbers * sizeof(double));
static_assert(offsetof(MeshTouch, normal_before) == MeshTouch::kNormalBefore * sizeof(double));
static_assert(offsetof(MeshTouch, velocity) == MeshTouch::kVelocity * sizeof(double));
static_assert(offsetof(MeshTouch, spin) == MeshTouch::kSpin * sizeof(double));

// Does what touch_walls() does for meshes. `at` holds the places of the contacts, up to a multiple of kBlock.
// The second bodies of `in` are not read.
void touch_meshes(const GeometryInput& in, const MeshTouch* at, TouchChunk& out);

}  // namespace grainreel
