// The grains with which another engine begins.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/handover/carried_scene.hpp"
#include "engine/run/simulation/simulation.hpp"

namespace grainreel {

struct StartState {
    // By rising id, which counts from 1 here as engines want it: ours + 1. Glued grains come last.
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
    bool stopped = false;  // by the watcher; nothing else holds then
    bool settled = true;   // false: the time limit ended our packing
};

// Packs as a run of ours does, or lays the grains out on a lattice where the deck packs. Sets the box of
// `carried` (low, high) so that it holds all of them. Throws UserError and RunError as Simulation does.
StartState start_state(CarriedScene& carried, int threads, const PackingWatcher& watcher);

// Writes a file for atom_style sphere, and for LIGGGHTS' granular. types: how many the deck has, for LIGGGHTS
// counts walls among them.
void write_data_file(const std::filesystem::path& path, const CarriedScene& carried, const StartState& start,
                     std::size_t types);

}  // namespace grainreel
