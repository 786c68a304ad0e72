// The walls of a scene as flat pieces in space, for the page's view of the bed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/bed.hpp"
#include "engine/state/state.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// A convex piece of wall, m, in the frame of its body at rest.
struct Slab {
    std::int32_t body = 0;              // its number in State::bodies (engine/state/pose.hpp)
    std::vector<Vec3> inner;            // corners of the side towards the grains, in order around it
    std::vector<Vec3> outer;            // the other side of its thickness, corner by corner; empty for a pane
    std::vector<int> seams = {};        // sides of `inner` (number of the first corner) without an edge line
    std::optional<double> from, until;  // s: when it comes and goes, if it does
};

// Slabs of container, floor and planes, with the thickness that they have in the film.
std::vector<Slab> slabs_of(const FilmedScene& scene);

// The box of what the film looks at (extent_of()), enlarged so that it holds the slabs at rest.
Extent box_of(const std::vector<Slab>& slabs, const FilmedScene& scene);

// Enlarges the box so that it holds the slabs of turned bodies at these moments. Of many moments it looks at
// a sample.
void take_turned(Extent& box, const std::vector<Slab>& slabs, const std::vector<State>& moments);

}  // namespace grainreel
