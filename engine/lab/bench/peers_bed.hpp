// The bed on which other engines are measured: 9,000 grains of 1 mm above 1,125 of 2 mm in a box of 20 mm,
// spring-dashpot contacts with friction history, and a floor that is shaken at 25 Hz. These engines are
// called peers here.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

struct PeersBed {
    double side = 0.02;                      // m
    double density = 2500;                   // kg/m3
    std::vector<Vec3> small_ones, big_ones;  // m, centres; the box goes from 0 to `side`
};

// The places from which the grains fall: lattices with random shifts. The coordinates are rounded to eight
// digits, as in the files that the peers read. Those files were made with seed 7.
PeersBed peers_bed(std::uint32_t seed = 7, int small_count = 9000, int big_count = 1125, double side = 0.02);

// Diameters of the small and the big grains in m.
constexpr double kPeersSmall = 0.001, kPeersBig = 0.002;

Grains peers_grains(const PeersBed& bed);

// kn 1000 N/m, kt 285.7 N/m, gamma_n 2634 1/s, gamma_t 1317 1/s, mu 0.5, walls the same; step 2e-6 s.
Plan peers_plan();

// Walls and gravity. The floor moves as a (1 - cos wt) with a = 1.19 mm from step 0 on.
Surroundings peers_surroundings(const PeersBed& bed, const Plan& plan);

// A bed at rest, for pictures. The peers' grains settle with softer springs than in peers_plan(), so that the
// step can be longer. Only the places of the grains matter.

struct SettledBed {
    Grains grains;      // with the floor at z = 0 and the box around the z axis
    double side = 0;    // m, of the box
    double height = 0;  // m, top of the highest grain
};

// Settles about `grains` grains. If they are fewer than 10,125, the box is narrower. If they are more, k x k
// copies of the bed of 10,125 grains stand side by side, where k is the root of grains / 10,125, rounded.
// watcher(share done) returns false to stop, and the result is then empty.
SettledBed settled_bed(int grains, int threads, const std::function<bool(double)>& watcher);

}  // namespace grainreel
