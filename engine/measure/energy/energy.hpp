// Energies of the grains. J.
#pragma once

#include <cstdint>

#include "engine/state/grains.hpp"

namespace grainreel {

class StepLoop;
struct Surroundings;

struct Kinetic {
    double translation = 0, rotation = 0;
};

Kinetic kinetic_energy(const Grains& grains);
double gravitational_energy(const Grains& grains, const Vec3& gravity);  // zero at the origin
double wall_work(const Grains& grains);  // by moving walls, since the drive started

// What all contacts would give back, and how they stand. One pass over the contacts.
struct ContactSummary {
    double stored = 0;           // J
    double carrying = 0;         // contacts that carry force, a pair counted for both grains
    double largest_overlap = 0;  // over the smaller radius
};
ContactSummary summarise_contacts(const StepLoop& loop, std::int64_t step);

// J: kinetic, rotational, gravitational and elastic together.
double total_energy(const Surroundings& around, const Grains& grains, const StepLoop& loop,
                    std::int64_t step);

}  // namespace grainreel
