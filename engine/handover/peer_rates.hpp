// How fast the other engines are, and when a run is better off there.
//
// Steps of a grain a second and rank, measured on the machine that ../notes/performance.md is about: beds of
// 640 and 3,000 grains in a wedge, LAMMPS of 29 Sep 2021 and LIGGGHTS 3.8.0, one and two ranks. Published
// scaling (Golshan et al. 2023, Lethe; the LAMMPS benchmarks) is best at 5,000 to 15,000 grains a rank, and
// falls below a few thousand. Memory was measured with a packed bed of 100,000 grains on one rank: 2,060
// bytes a grain in LAMMPS and 1,400 in LIGGGHTS beyond the 30 MB of the program.
#pragma once

#include <cstdint>
#include <string>

#include "engine/handover/carried_scene.hpp"

namespace grainreel {

struct PeerRate {
    double standing = 0;       // grain-steps a second and rank, all walls standing still
    double moving = 0;         // walls that move
    double bytes_a_grain = 0;  // on all ranks together
};
PeerRate rate_of(PeerEngine engine);

// Ranks that a bed of so many grains feeds: 5,000 grains each, at least one.
std::int64_t useful_ranks(std::int64_t grains);
// s: so many steps on so many ranks, at four fifths of the speed that they would have without each other.
double peer_seconds(PeerEngine engine, RunFrame frame, std::int64_t grains, std::int64_t steps, int ranks);
double peer_bytes(PeerEngine engine, std::int64_t grains);

// Ranks of the faster engine that do what one thread of ours does.
inline constexpr double kRanksAThread = 7;

}  // namespace grainreel
