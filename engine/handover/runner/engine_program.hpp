// The programs of other engines on this machine.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/handover/carried_scene.hpp"

namespace grainreel {

struct EngineProgram {
    std::filesystem::path path;
    std::string version;  // "29 Sep 2021 - Update 2", "3.8.0"
};

// A program by its name among the folders of PATH; empty where none has it.
std::filesystem::path program_named(const std::string& name);

// `lmp` or `liggghts`. Throws UserError where it is not installed, and names Debian's package; where it does
// not start; and for LAMMPS of 28 Mar 2023, whose walls act on all grains whatever their group.
EngineProgram find_engine(PeerEngine engine);
// The version among the first lines that the engine says of itself; empty where there is none.
std::string version_in(PeerEngine engine, const std::string& text);
// Throws UserError for versions whose results would be wrong.
void check_version(PeerEngine engine, const std::string& version);

// The words that start so many ranks of it with a deck. Throws UserError where there is no mpirun, and where
// this process may use fewer processors than ranks.
struct RankWords {
    std::vector<std::string> words;
    std::vector<std::string> notes;  // what the user should know, a line each
};
RankWords rank_words(PeerEngine engine, const EngineProgram& program, const std::string& deck, int ranks);

}  // namespace grainreel
