// Estimates the work of the engine for a run. Work is counted in steps of a grain in the lattice by which the
// machine is measured (lattice_speed()); each grain there has six contacts and is at rest.
//
// The cost of a grain's step depends on its number of contacts. A bed at rest has 4.5 contacts for each
// grain, and so has a bed whose acceleration stays below gravity. A bed that is thrown up has fewer: 2.6 at
// 1.2 g, 0.6 at 2 g, 0.2 at 3 g, all means over a period.
#pragma once

#include "engine/plan/plan.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct EngineCost {
    // Work, in grain-steps of the lattice.
    double packing = 0, run = 0;
    // Number of time steps.
    double packing_steps = 0, run_steps = 0;
};

// Estimates the cost. The run includes rows of measures, instruments and fields.
EngineCost engine_cost(const FilmedScene& scene, const Plan& plan);

// Mean number of contacts of a grain over the run.
double mean_contacts(const FilmedScene& scene, const Plan& plan);

}  // namespace grainreel
