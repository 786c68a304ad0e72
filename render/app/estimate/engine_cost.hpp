// What the engine does for a run, counted in steps of a grain of the lattice that the machine is measured by
// (lattice_speed.hpp): six contacts each, all at rest.
//
// A step of a grain costs by how many contacts it has. A bed at rest has 4.5 contacts a grain, and so has one
// that is shaken more gently than gravity. A bed that is thrown up has few: 2.6 at 1.2 g, 0.6 at 2 g, 0.2 at
// 3 g, all means over a period.
#pragma once

#include "engine/plan/plan.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct EngineCost {
    // Grain-steps of the lattice.
    double packing = 0, run = 0;
    // Steps of the scene's grains.
    double packing_steps = 0, run_steps = 0;
};

// Rows of measures, instruments and fields are in the run.
EngineCost engine_cost(const FilmedScene& scene, const Plan& plan);

// Contacts a grain, the mean over the run.
double mean_contacts(const FilmedScene& scene, const Plan& plan);

}  // namespace grainreel
