// Times the steps of a bench case phase by phase: its speed, and how much time each stage of a step takes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/lab/bench/bench_case.hpp"
#include "engine/step/threads/work_shares.hpp"

namespace grainreel {

struct BenchRequest {
    int threads = 0;    // 0: as many as there are processors
    int particles = 0;  // 0: as many as the case has
    int repeats = 1;
    bool quick = false;  // makes a tenth of all steps
    Precision precision = Precision::full;
};

struct PhaseResult {
    std::string name;
    std::int64_t steps = 0;              // number of timed steps
    std::vector<double> particle_steps;  // grain-steps a second, one value for each repetition
    // Grain-steps a second of a single copy in the same steps, one value for each time that it was timed.
    // Empty if the grains are not copies of a bed.
    std::vector<double> of_one_copy;
    std::int64_t listed = 0;             // pairs in the neighbour lists at the phase's end
    std::int64_t touching = 0;           // touching pairs at the phase's end
    std::array<double, kCosts> stage{};  // ns of one thread for a step of a grain, from the median repetition

    double median() const;  // grain-steps a second
    double spread() const;  // (largest - smallest) / median
    double median_of_one_copy() const;
};

struct BenchResult {
    std::string name;
    std::int64_t particles = 0;
    int threads = 0;
    Precision precision = Precision::full;
    double bytes_per_particle = 0;  // memory of the heap in use at the end, for each grain
    std::uint64_t state_hash = 0;   // hash of all places, velocities and spins at the end, by id
    std::vector<PhaseResult> phases;
};

// watcher(what is done now, share done) returns false to stop; the result is then incomplete.
using BenchWatcher = std::function<bool(const std::string&, double)>;
struct BenchOutcome {
    BenchResult result;
    bool complete = false;
};
BenchOutcome run_bench(const BenchCase& bench, const BenchRequest& request, const BenchWatcher& watcher);

// A hash of places, velocities and spins, by id.
std::uint64_t hash_of_motion(const Grains& grains);

// How fast this machine steps grains, measured in a tenth of a second.

// Grain-steps a second of a team of so many threads, on a cubic lattice of 1,728 spheres, each pressed a
// little into its six neighbours (Walton-Braun corrected, incremental slip). It is the fastest of many
// short stretches. Time is the processor time of all threads divided by their number. It includes their
// waiting for each other, but hardly any other work of the machine.
double lattice_speed(int threads);

}  // namespace grainreel
