// Health of a run: a state that is no longer physics stops it, naming step, grain, place and remedy.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/base/clock.hpp"
#include "engine/scene/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

struct HealthLimits {
    Clock clock;
    double overlap = 1.0 / 3.0;        // over the smaller radius
    std::vector<std::string> species;  // names, for messages
};

HealthLimits health_limits(const Scene& scene, const Plan& plan);

// Throws RunError when a grain has left the finite numbers or the container, or overlaps too far.
void check_state(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                 const StepLoop& loop, std::int64_t step);

// Watches the energy balance: without work done on them, grains can only lose energy.
class EnergyWatch {
  public:
    // energy: J, total; work: J, done by walls so far; allowance: J, below which nothing is said.
    // Throws RunError when energy - work has risen above its lowest value so far by more than 5 % of all that
    // was turned over, plus the allowance.
    void check(double energy, double work, double allowance, const Clock& clock, std::int64_t step);

  private:
    double lowest_ = std::numeric_limits<double>::infinity();
    double first_ = std::numeric_limits<double>::quiet_NaN();
    double work_done_ = 0;
};

}  // namespace grainreel
