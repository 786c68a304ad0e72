// Grains that leave a run and grains that enter it: where they leave, which have left, and an account of
// both.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/random.hpp"
#include "engine/base/vector.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// A region in which no grain stays: a grain whose centre is in it at the end of a step leaves in that step.
// The region is convex. With one half-space, grains leave through its plane.
struct Exit {
    // The points p with normal . p < distance.
    struct HalfSpace {
        Vec3 normal{0, 0, 1};  // unit
        double distance = 0;   // m
    };
    std::vector<HalfSpace> sides;  // the region is where all of them overlap; without any there is no exit

    // Whether the region holds a centre, if every side is moved outwards by `reach` (m).
    bool holds(const Vec3& centre, double reach = 0) const {
        return !sides.empty() && std::all_of(sides.begin(), sides.end(), [&](const HalfSpace& side) {
            return side.normal.dot(centre) < side.distance + reach;
        });
    }
};

// The region below a height (m).
inline Exit exit_below(double height) {
    return {{{Vec3(0, 0, 1), height}}};
}

// A grain as it was when it left, at the end of its last step.
struct Departure {
    std::int64_t step = 0;
    std::int32_t id = 0, species = 0;
    double radius = 0, mass = 0;                               // m, kg
    Vec3 position{0, 0, 0}, velocity{0, 0, 0}, spin{0, 0, 0};  // m, m/s, rad/s
    double energy = 0;  // J: kinetic, gravitational, and what its contacts held
};

struct ComingGrain {
    std::int32_t species = 0;
    double radius = 0, density = 0;                            // m, kg/m3
    Vec3 position{0, 0, 0}, velocity{0, 0, 0}, spin{0, 0, 0};  // m, m/s, rad/s
};

// The account of a run: what it had at its start, plus what came, less what left, is what it has now.
// Checkpoints hold it as it lies in memory.
struct Traffic {
    std::int64_t came = 0, left = 0;
    double energy_in = 0,
           energy_out = 0;      // J, as in Departure; energy stored at an outlet's gate counts as gone out
    double work_out = 0;        // J, work that moving walls had done on grains that have left
    std::int64_t next_id = 0;   // larger than all ids so far; 0 until a grain has come or left
    std::int64_t openings = 0;  // number of outlets that have opened

    bool any() const { return came != 0 || left != 0 || next_id != 0 || openings != 0; }
};

// A grain of a feed, without its place. `feed` is the number of the feed in the scene, and `number` is the
// grain's number in the feed, from 0. Scene and seed determine the grain, so the number of grains that have
// come tells which ones have come.
inline ComingGrain fed_grain(const Scene& scene, std::size_t feed, std::int64_t number) {
    const Feed& from = scene.feeds[feed];
    const Species& species = scene.species[from.species];
    Random random(scene.run.seed, Stream::feed_sizes, {static_cast<std::int64_t>(feed), number});
    ComingGrain grain;
    grain.species = static_cast<std::int32_t>(from.species);
    grain.radius = 0.5 * draw_diameter(species.diameter, random);
    grain.density = species.density;
    grain.velocity = from.velocity;
    return grain;
}

}  // namespace grainreel
