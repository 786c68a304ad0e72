// Infinite walls as far as they can be drawn: cut to the box.
#pragma once

#include "engine/base/vector.hpp"
#include "engine/files/frames/world.hpp"
#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

// The part of the plane through `place` that lies in the box, whose edges are along the axes. `outwards` is
// its normal, away from the grains; the surface looks the other way. Of a plane beside the box as much as the
// box has before it; empty where the normal is none.
TriangleMesh plane_in_box(const Vec3& place, const Vec3& outwards, const WorldCell& box);

}  // namespace grainreel
