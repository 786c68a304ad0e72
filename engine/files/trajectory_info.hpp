// What the files of a run's moments say of the run: trajectory.nc, film_moments.nc, key_moments.nc.
#pragma once

#include <string>

#include "engine/files/trajectory.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// With room for all grains that the plan expects.
TrajectoryInfo trajectory_info(const Scene& scene, const Plan& plan, const std::string& program_version);

}  // namespace grainreel
