// Writes the folder that is handed over: data, deck, walls, run.sh, a script for Slurm, handover.toml and
// scene.toml. Also reads handover.toml, and says how fast the other engines run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/handover/carried_scene.hpp"
#include "engine/handover/start_state.hpp"

namespace grainreel {

// Writes all files into an empty folder. version: of our program.
void write_handover(const std::filesystem::path& folder, const CarriedScene& carried, const StartState& start,
                    const std::string& version);

// What handover.toml says, for reading the dump back.
struct HandoverFacts {
    PeerEngine engine = PeerEngine::lammps;
    int ranks = 1;
    ReferenceFrame frame = ReferenceFrame::lab;
    double step = 0;                              // s
    std::int64_t shift = 0;                       // the engine's step is ours plus this
    std::int64_t first = 0, last = 0;             // first and last step, as we count
    std::int64_t grains = 0, glued = 0, fed = 0;  // at the start; glued to walls; fed later
    bool leave = false;                           // whether grains may leave
    std::int64_t dumps = 0;                       // number of dumps of a whole run
    std::vector<std::string> changes;             // what was changed, and why
    std::filesystem::path dump;                   // full path
};
// Whether the folder has a handover.toml.
bool is_handover(const std::filesystem::path& folder);
// Reads handover.toml. Throws UserError with the line of what is wrong.
HandoverFacts read_handover(const std::filesystem::path& folder);

// The text of run.sh [--continue]. It starts the ranks, refuses the version of LAMMPS whose walls ignore
// groups, allows Open MPI to run as root if root runs it, and writes the engine's output into a file.
std::string run_script(const CarriedScene& carried);
// The script for `sbatch`, which does the same with the tasks of the job.
std::string slurm_script(const CarriedScene& carried);

// How fast an engine is: steps of a grain per second and rank. Measured on the machine of
// docs/notes/performance.md with beds of 640 and 3,000 grains in a wedge, LAMMPS of 29 Sep 2021 and
// LIGGGHTS 3.8.0 on one and two ranks. Published scaling (Golshan et al. 2023, Lethe; the LAMMPS benchmarks)
// is best at 5,000 to 15,000 grains for each rank, and falls below a few thousand. Memory was measured with a
// packed bed of 100,000 grains on one rank: 2,060 bytes for each grain in LAMMPS and 1,400 in LIGGGHTS,
// besides the 30 MB of the program.
struct PeerRate {
    double standing = 0;       // grain-steps per second and rank while all walls stand still
    double moving = 0;         // the same with moving walls
    double bytes_a_grain = 0;  // on all ranks together
};
PeerRate rate_of(PeerEngine engine);

// Number of ranks that are of use for so many grains: one for each 5,000 grains, at least one.
std::int64_t useful_ranks(std::int64_t grains);
// Time in s for so many steps. Where there are several ranks, each has four fifths of the speed of a single
// one.
double peer_seconds(PeerEngine engine, ReferenceFrame frame, std::int64_t grains, std::int64_t steps,
                    int ranks);
double peer_bytes(PeerEngine engine, std::int64_t grains);

// So many ranks of the faster engine are as fast as one thread of ours.
inline constexpr double kRanksAThread = 7;

}  // namespace grainreel
