// Grains that leave a run and grains that enter it: where they leave, who has left, and the account of both.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// A region in which no grain stays: one whose centre is in it at the end of a step leaves in that step. The
// region is convex, and one half-space is a plane that grains leave through.
struct Exit {
    // The points p with normal . p < distance.
    struct HalfSpace {
        Vec3 normal{0, 0, 1};  // unit
        double distance = 0;   // m
    };
    std::vector<HalfSpace> sides;  // all of them hold; none: no exit

    // reach: m, by which every side is moved outwards.
    bool holds(const Vec3& centre, double reach = 0) const {
        return !sides.empty() && std::all_of(sides.begin(), sides.end(), [&](const HalfSpace& side) {
            return side.normal.dot(centre) < side.distance + reach;
        });
    }
};

// All that is below a height; m.
inline Exit exit_below(double height) {
    return {{{Vec3(0, 0, 1), height}}};
}

// A grain as it was when it left, at the end of its last step.
struct Departure {
    std::int64_t step = 0;
    std::int32_t id = 0, species = 0;
    double radius = 0;                                         // m
    Vec3 position{0, 0, 0}, velocity{0, 0, 0}, spin{0, 0, 0};  // m, m/s, rad/s
    double energy = 0;  // J: kinetic, gravitational, and what its contacts held
};

struct NewGrain {
    std::int32_t species = 0;
    double radius = 0, density = 0;                            // m, kg/m3
    Vec3 position{0, 0, 0}, velocity{0, 0, 0}, spin{0, 0, 0};  // m, m/s, rad/s
};

// The account: what a run had at its start, plus what came, less what left, is what it has.
struct Traffic {
    std::int64_t came = 0, left = 0;
    double energy_in = 0, energy_out = 0;  // J, as of a Departure; what an outlet's gate held went out too
    double work_out = 0;                   // J, that moving walls had done on grains that have left
    std::int64_t next_id = 0;              // above all ids that there were, as far as grains came or left
    std::int64_t openings = 0;             // of outlets

    bool any() const { return came != 0 || left != 0 || next_id != 0 || openings != 0; }
};

// The n-th grain that a feed gives, all but its place. Scene and seed settle it, so that the number of grains
// that have come tells which ones have come. feed: which of the scene's; number: from 0.
NewGrain fed_grain(const Scene& scene, std::size_t feed, std::int64_t number);

}  // namespace grainreel
