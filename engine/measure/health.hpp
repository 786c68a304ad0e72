// The health of a run: a state that is no longer physics stops it. The message names step, grain, place and
// remedy.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/base/clock.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

struct HealthLimits {
    Clock clock;
    double overlap = 1.0 / 3.0;                                   // over the smaller radius
    std::vector<std::string> species;                             // names, for messages
    double safe_speed = std::numeric_limits<double>::infinity();  // m/s, of two grains against each other:
                                                                  // no impact below it overlaps so far
    double smallest_radius = std::numeric_limits<double>::infinity();  // m
    double wall_speed = 0;     // m/s, of the fastest wall with a motion of its own
    std::int32_t vessel = -1;  // the number of the mesh that is closed around all grains, if there is one
};

HealthLimits health_limits(const Scene& scene, const Plan& plan);

// Throws RunError when a grain has left the finite numbers or the container, overlaps too far, or is so fast
// that it may pass another between two steps.
void check_state(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                 const StepLoop& loop, std::int64_t step);

// How many steps may go by until the next look, so that no impact that overlaps too far begins and ends
// unseen: many, where the speeds are safe.
std::int64_t steps_to_next_look(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                                std::int64_t step);

// Watches the energy balance: without work done on them, grains can only lose energy.
class EnergyWatch {
  public:
    // energy: J, total; work: J, done by walls so far; through: J, the sizes of all terms of both added up;
    // allowance: J, below which nothing is said.
    // Throws RunError when energy - work has risen above its lowest value so far by more than 5 % of all that
    // was turned over and of the motion there is, plus the allowance, plus what rounding may do to the
    // largest sum there was.
    void check(double energy, double work, double through, double allowance, const HealthLimits& limits,
               const Grains& grains, std::int64_t step);

  private:
    double lowest_ = std::numeric_limits<double>::infinity();
    double first_ = std::numeric_limits<double>::quiet_NaN();
    double work_done_ = 0;
    double largest_through_ = 0;
};

}  // namespace grainreel
