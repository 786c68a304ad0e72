// The files that grow in a run that goes on (is resumed): how far they reach, and checks of all of them
// before any is changed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/former_files.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Whether the run has a fields.nc, with fields on a grid or pressures on walls.
bool keeps_fields(const Scene& scene);

// Steps of a trajectory's frames, up to the first damaged one; empty if there is no such file.
std::vector<std::int64_t> steps_in_trajectory(const std::filesystem::path& file);
// The steps of the rows of measures.csv, up to the first damaged one; empty if there is no such file.
std::vector<std::int64_t> steps_in_measures(const std::filesystem::path& file);

// Checks the files that a resumed run goes on with. Call it before any of them is changed. Throws UserError
// if one is missing or cannot be read.
void check_files_of_run(const std::filesystem::path& run, const Scene& scene, const Plan& plan);

// The step that a run has reached, by its last checkpoint and by the rows of measures.csv, because a
// checkpoint may have been lost.
std::int64_t reached_step(const std::filesystem::path& run, std::int64_t last_checkpoint);

// Whether the files have everything that a run from `first` on writes before `step`.
bool files_reach(const std::filesystem::path& run, const Scene& scene, const Plan& plan, std::int64_t first,
                 std::int64_t step);

struct ReadyFiles {
    bool key_moments = false;      // whether the run goes on with its key moments
    std::string key_moments_lost;  // what is wrong with them; empty if nothing is, or if the run has none
};

// Opens and checks each file with which the run goes on from the simulation's step, and tells `former` where
// it will be cut. A file with too few places for the grains to come is written again with more. `frames` is
// the number of frames of film_moments.nc that are kept; empty if that file is left alone. Throws UserError
// for a file with which the run cannot go on.
ReadyFiles ready_files(const std::filesystem::path& run, const Scene& scene, const Plan& plan,
                       const SimulatedBed& simulation, std::optional<std::size_t> frames,
                       const std::string& program_version, FormerFiles& former);

}  // namespace grainreel
