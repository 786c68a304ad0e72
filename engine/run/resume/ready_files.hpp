// The growing files of a run that goes on, before any of them is touched.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "engine/files/former_run.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/simulation/simulation.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct ReadyFiles {
    bool key_moments = false;      // the run goes on with them
    std::string key_moments_lost;  // what is wrong with them; empty: nothing, or the run has none
};

// Opens each file with which the run goes on from where the simulation is, checks it, and tells `former`
// where it will be cut. A file that has not enough places for the grains that are to come is written again
// with more. frames: how many of film_moments.nc are kept; none where that file is left alone. Throws
// UserError for a file with which the run cannot go on.
ReadyFiles ready_files(const std::filesystem::path& run, const Scene& scene, const Plan& plan,
                       const Simulation& simulation, std::optional<std::size_t> frames,
                       const std::string& program_version, FormerRun& former);

}  // namespace grainreel
