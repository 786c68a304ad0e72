// The folder that is handed over: data, deck, walls, run.sh, a script for Slurm, handover.toml, scene.toml.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/handover/carried_scene.hpp"
#include "engine/handover/start_state.hpp"

namespace grainreel {

// Writes all into a folder, which is there and empty. version: of our program.
void write_handover(const std::filesystem::path& folder, const CarriedScene& carried, const StartState& start,
                    const std::string& version);

// What handover.toml says, for who reads the dump back.
struct HandoverFacts {
    PeerEngine engine = PeerEngine::lammps;
    int ranks = 1;
    RunFrame frame = RunFrame::lab;
    double step = 0;                              // s
    std::int64_t shift = 0;                       // the engine's step is ours and so many more
    std::int64_t first = 0, last = 0;             // steps of ours
    std::int64_t grains = 0, glued = 0, fed = 0;  // at the start; parts of walls; that come
    bool leave = false;                           // whether grains may leave
    std::int64_t dumps = 0;                       // that a whole run writes
    std::vector<std::string> changes;             // what and why
    std::filesystem::path dump;                   // full path
};
// Whether the folder has a handover.toml.
bool is_handover(const std::filesystem::path& folder);
// Throws UserError with the line of what is wrong.
HandoverFacts read_handover(const std::filesystem::path& folder);

// The shell scripts of a hand-over's folder.

// run.sh [--continue]: starts the ranks, refuses the version whose walls ignore groups, allows root to Open
// MPI where it is root that runs it, and writes the engine's words into a file.
std::string run_script(const CarriedScene& carried);
// For `sbatch`: the same with the job's tasks.
std::string slurm_script(const CarriedScene& carried);

// How fast the other engines are, and when a run is better off there.
//
// Steps of a grain a second and rank, measured on the machine that ../notes/performance.md is about: beds of
// 640 and 3,000 grains in a wedge, LAMMPS of 29 Sep 2021 and LIGGGHTS 3.8.0, one and two ranks. Published
// scaling (Golshan et al. 2023, Lethe; the LAMMPS benchmarks) is best at 5,000 to 15,000 grains a rank, and
// falls below a few thousand. Memory was measured with a packed bed of 100,000 grains on one rank: 2,060
// bytes a grain in LAMMPS and 1,400 in LIGGGHTS beyond the 30 MB of the program.

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
