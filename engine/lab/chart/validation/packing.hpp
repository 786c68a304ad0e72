// Spheres jammed without gravity and decompressed: random close packing.
//
// Grains with random centres between two pairs of smooth walls (periodic along x) are let go, strongly
// damped, until they rest: a quench of an infinitely hot state, as O'Hern, Silbert, Liu & Nagel (2003, Phys.
// Rev. E 68, 011306) make theirs. Then all radii shrink in small steps, with rest after each, and the
// pressure falls towards zero. Contacts are harmonic springs that lose nothing; a drag takes the energy.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/plan/plan.hpp"

namespace grainreel {

struct JammedPacking {
    int grains = 4000;
    double friction = 0;            // among grains; the walls have none
    double solid_fraction = 0.645;  // of the whole box at first
    double margin = 3;              // diameters: what is nearer to a wall is left out of the measures
    double share = 0.4;             // of the distance to jamming, that each decompression takes away
    std::uint64_t seed = 1;
    Precision precision = Precision::full;
};

// At one pressure, away from the walls.
struct PackingState {
    double pressure = 0;        // p d / K, d the diameter at first, K the stiffness
    double solid_fraction = 0;  // of the volume, rattlers and cut grains counted as far as they lie in it
    double contacts = 0;        // a grain that is no rattler, with others that are none
    double rattlers = 0;        // share of the grains
    double unbalanced = 0;      // rms net force on a grain, over the mean contact force
};

// At most `states` of them, of falling pressure; fewer when the packing comes apart.
std::vector<PackingState> decompress(const JammedPacking& packing, int states);

// Where straight lines through the states below p d / K = 0.003 (at least the last three) reach zero
// pressure: the solid fraction is linear in p for harmonic springs, the contacts in sqrt p (O'Hern et al.
// 2003).
struct JammingPoint {
    double solid_fraction = 0, contacts = 0;
    double rise = 0;  // of the contacts with the root of the solid fraction: (z - z_c) / sqrt(phi - phi_c)
};
JammingPoint jamming_point(const std::vector<PackingState>& states);

// m3: of a sphere, the part with y in [low.y, high.y] and z in [low.z, high.z]; x is not cut.
double volume_within(const Vec3& centre, double radius, const Vec3& low, const Vec3& high);

}  // namespace grainreel
