// Times a case: speed and what it goes into, phase by phase.
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
    bool quick = false;  // a tenth of all steps
    Precision precision = Precision::full;
};

struct PhaseReport {
    std::string name;
    std::int64_t steps = 0;              // timed
    std::vector<double> particle_steps;  // a second, of each repetition
    // Where grains are copies of a bed: those of a single copy in the same steps.
    std::vector<double> of_one_copy;
    std::int64_t listed = 0;             // pairs in the neighbour lists at its end
    std::int64_t touching = 0;           // pairs
    std::array<double, kCosts> stage{};  // ns of a thread for a step of a grain, of the median repetition

    double median() const;  // particle steps a second
    double spread() const;  // (largest - smallest) / median
    double median_of_one_copy() const;
};

struct BenchReport {
    std::string name;
    std::int64_t particles = 0;
    int threads = 0;
    Precision precision = Precision::full;
    double bytes_per_particle = 0;  // of heap in use at the end, all that the run asked for
    std::uint64_t state_hash = 0;   // of all places, velocities and spins at the end, by id
    std::vector<PhaseReport> phases;
};

// watcher(what is done now, share done): false stops, and the report is then incomplete.
using BenchWatcher = std::function<bool(const std::string&, double)>;
struct BenchOutcome {
    BenchReport report;
    bool complete = false;
};
BenchOutcome run_bench(const BenchCase& bench, const BenchRequest& request, const BenchWatcher& watcher);

// A hash of places, velocities and spins, by id.
std::uint64_t hash_of_motion(const Grains& grains);

// How fast this machine steps grains, told in a tenth of a second.

// Grain-steps a second of a team of so many: a cubic lattice of 1,728 spheres, each pressed a little into its
// six neighbours (Walton-Braun corrected, incremental slip), the fastest of many short stretches. Time is
// that of the processors over the threads, whose waiting for each other is in it: what else the machine does
// counts little.
double lattice_speed(int threads);

}  // namespace grainreel
