// A bed at rest to be drawn: the peers' grains, let down on softer springs with a longer step, since only
// their places matter.
#pragma once

#include <functional>

#include "engine/state/grains.hpp"

namespace grainreel {

struct SettledBed {
    Grains grains;      // the floor at z = 0, the box around the z axis
    double side = 0;    // m, of the box
    double height = 0;  // m, of the highest grain's top
};

// Fewer than 10,125 grains lie in a narrower box; more are k x k copies side by side, as near to `grains` as
// these come. watcher(share done): false stops, and the result is then empty.
SettledBed settled_bed(int grains, int threads, const std::function<bool(double)>& watcher);

}  // namespace grainreel
