// The folder that is handed over: data, deck, walls, run.sh, a script for Slurm, handover.toml, scene.toml.
#pragma once

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

}  // namespace grainreel
