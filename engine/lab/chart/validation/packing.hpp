// Random close packing: spheres are jammed without gravity and then decompressed.
//
// Grains with random centres, which overlap, are between two pairs of smooth walls (periodic along x). They
// push each other apart, strongly damped, until they rest: a quench of an infinitely hot state, as in O'Hern,
// Silbert, Liu & Nagel (2003, Phys. Rev. E 68, 011306). Then all radii shrink in small steps. After each the
// grains come to rest again, and the pressure falls towards zero. Contacts are harmonic springs that lose
// nothing; a drag takes the energy.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/plan/plan.hpp"

namespace grainreel {

struct JammedPacking {
    int grains = 4000;
    double friction = 0;            // among grains; the walls have none
    double solid_fraction = 0.645;  // share of the whole box at the start
    double margin = 3;              // diameters; a layer this thick at each wall is not measured
    double share = 0.4;             // each decompression reduces the distance to jamming by this share
    std::uint64_t seed = 1;
    Precision precision = Precision::full;
};

// The packing at one pressure, away from the walls. The chart fills it from the columns of packing.csv in
// this order.
struct PackingState {
    double pressure = 0;        // p d / K, with the diameter d at the start and the stiffness K
    double solid_fraction = 0;  // of the measured volume; includes rattlers and parts of grains at its border
    double contacts = 0;        // contacts a grain, counting only grains that are no rattlers
    double rattlers = 0;        // share of the grains
    double unbalanced = 0;      // rms net force on a grain, divided by the mean contact force
};

// At most `states` states of falling pressure; fewer when the packing comes apart.
std::vector<PackingState> decompress(const JammedPacking& packing, int states);

// Solid fraction and contacts at zero pressure, extrapolated by straight lines through the states below
// p d / K = 0.003 (at least the last three). For harmonic springs the solid fraction is linear in p, and the
// contacts in sqrt p (O'Hern et al. 2003).
struct JammingPoint {
    double solid_fraction = 0, contacts = 0;
    double rise = 0;  // how contacts grow with the solid fraction: (z - z_c) / sqrt(phi - phi_c)
};
JammingPoint jamming_point(const std::vector<PackingState>& states);

// Volume (m3) of the part of a sphere with y in [low.y, high.y] and z in [low.z, high.z]; x is not cut.
double volume_within(const Vec3& centre, double radius, const Vec3& low, const Vec3& high);

}  // namespace grainreel
