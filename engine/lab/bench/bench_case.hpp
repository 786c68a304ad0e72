// The beds of grains whose steps `grainreel bench` times.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

struct BenchBed {
    Plan plan;
    Surroundings around;
    Grains grains;
};

struct BenchPhase {
    std::string name;
    std::int64_t steps;
};

struct BenchCase {
    std::string name, about;
    int particles;            // number of grains unless the caller asks for another
    std::int64_t first_step;  // first step of the first phase; the drive starts at step 0
    std::int64_t lead;        // steps before `first_step`, which are not timed
    double lead_drag;         // 1/s, drag during these steps
    std::vector<BenchPhase> phases;
    BenchBed (*bed)(int particles);
    // If more grains than `particles` are asked for, copies of the bed stand side by side, with walls around
    // all of them. This gives the side (m) of one copy along x and y. nullptr where `bed` makes a larger bed
    // instead.
    double (*side_of_copies)(const BenchBed& bed) = nullptr;
};
const std::vector<BenchCase>& bench_cases();

// k x k copies side by side, centred as the bed is. The walls in x and y, which stand at +- side / 2 around
// the bed, are put around all copies.
BenchBed copied(const BenchBed& bed, const Grains& grains, double side, int k);

// The bed on which other engines are measured (peers_bed.hpp), with their law, with ours, and without
// friction.

std::vector<BenchCase> peers_cases();

// A bed at rest, with 4.7 contacts a grain throughout. In the phase "settled" of the other beds most grains
// are still falling, and there are only 0.5 to 1 contacts a grain.

BenchCase rest_case();

// Beds of scenes: the default film's hopper, one big grain among small ones, a gas.

std::vector<BenchCase> scene_cases();

// The scene of the default film, without its film.
const char* wedge_scene();

}  // namespace grainreel
