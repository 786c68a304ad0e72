// Makes the grains with which another engine begins: packed by us, or on a lattice where the deck packs them.
// Also writes the data file that holds them.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/handover/carried_scene.hpp"
#include "engine/run/simulation/simulated_bed.hpp"

namespace grainreel {

struct StartState {
    // Grains are in the order of ids, which are ours + 1, because engines count from 1. Glued grains come
    // last.
    struct Grain {
        std::int64_t id = 0;
        int type = 1;            // from 1
        double diameter = 0;     // m
        double density = 0;      // kg/m3
        Vec3 position{0, 0, 0};  // m, in the run's frame
        Vec3 velocity{0, 0, 0};  // m/s, as above
        Vec3 spin{0, 0, 0};      // rad/s
    };
    std::vector<Grain> grains;
    bool stopped = false;  // the watcher stopped the packing, and nothing else is valid
    bool settled = true;   // false if the time limit ended our packing
};

// Packs as a run of ours does, or puts the grains on a lattice if the deck packs. Sets the box of `carried`
// (low, high) so that it holds all grains. Throws UserError and RunError as SimulatedBed does.
StartState start_state(CarriedScene& carried, int threads, const PackingWatcher& watcher);

// Writes a file for atom_style sphere of LAMMPS and granular of LIGGGHTS. types: number of types in the deck,
// which for LIGGGHTS includes walls.
void write_data_file(const std::filesystem::path& path, const CarriedScene& carried, const StartState& start,
                     std::size_t types);

}  // namespace grainreel
