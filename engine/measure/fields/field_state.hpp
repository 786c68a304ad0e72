// What fields are made from: the grains and contacts of one moment, seen from the container.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

struct FieldGrain {
    Vec3 position;  // m
    Vec3 velocity;  // m/s
    double mass;    // kg
    double volume;  // m3
    std::int32_t species;
    double radius = 0;  // m, below which no kernel spreads it; 0: as a point
};

// A contact of a grain with another grain or a wall.
struct FieldContact {
    Vec3 begin;   // m, the grain's centre
    Vec3 branch;  // m, from there to the other grain's centre, or to the point of the wall that it touches
    Vec3 force;   // N, on the other body
    double radius = 0, other_radius = 0;  // m, of both grains; at a wall the grain's twice
};

struct FieldState {
    std::vector<FieldGrain> grains;
    std::vector<FieldContact> contacts;
};

}  // namespace grainreel
