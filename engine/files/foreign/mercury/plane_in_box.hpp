// An infinite wall as a surface that can be drawn: the part of it that lies in the box of the simulation.
#pragma once

#include "engine/base/triangle_mesh.hpp"
#include "engine/base/vector.hpp"
#include "engine/files/frames/stored_world.hpp"

namespace grainreel {

// The part of an infinite plane through `place` that lies in the box, whose edges are along the axes.
// `outwards` is the normal that points away from the grains; the front of the surface faces the other way. If
// the plane is outside the box, this is the cross-section at the nearest end of the box, moved onto the
// plane. It is empty where the normal has no length.
TriangleMesh plane_in_box(const Vec3& place, const Vec3& outwards, const WorldCell& box);

}  // namespace grainreel
