// The growing files of a run that goes on: how far they reach, and how they are opened and checked before any
// of them is touched.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/former_run.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/simulation/simulation.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

bool is_there(const std::filesystem::path& file);

// Whether the run has a fields.nc: of fields on a grid, or of the pressures on walls.
bool keeps_fields(const Scene& scene);

// Steps of a trajectory's frames, up to the first that is damaged; none where there is no such file.
std::vector<std::int64_t> steps_in_trajectory(const std::filesystem::path& file);
// The steps of the rows of measures.csv, up to the first that is damaged; none where there is no such file.
std::vector<std::int64_t> steps_in_measures(const std::filesystem::path& file);

// Throws UserError for a file that the run writes and that is missing or cannot be read, before any of them
// is touched.
void check_files_of_run(const std::filesystem::path& run, const Scene& scene, const Plan& plan);

// The step that a run has reached, by its last checkpoint and by the rows of measures.csv: a checkpoint may
// have been lost.
std::int64_t reached_step(const std::filesystem::path& run, std::int64_t last_checkpoint);

// Whether the files have all that a run which began at `first` has written before `step`.
bool files_reach(const std::filesystem::path& run, const Scene& scene, const Plan& plan, std::int64_t first,
                 std::int64_t step);

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
