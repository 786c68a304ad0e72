// Contacts of grains with grains that are glued to walls. Scenes without glued grains have no such contacts,
// and the kernels of pairs and of walls know nothing of them.
#pragma once

#include "engine/state/glued_grains.hpp"
#include "engine/step/geometry/contact_geometry.hpp"

namespace grainreel {

// Glued grains where their walls are. period: of x, in m; 0 for none.
struct GluedState {
    const GluedGrains& glued;
    const WallState& walls;
    double period;
};

// The face of each of `count` glued grains, and of those that fill their last block.
void find_faces(const GluedGrains& glued, const std::int32_t* second, int count, std::int32_t* face);

// As touching_walls() and touch_walls(); `second` are numbers of glued grains, and `face` what find_faces()
// gives.
std::uint64_t touching_glued(const Grains& grains, const std::int32_t* first, const std::int32_t* second,
                             int count, const GluedState& state);
void touch_glued(const GeometryInput& in, const GluedState& state, const std::int32_t* face, TouchChunk& out);

}  // namespace grainreel
