// Checks the health of a run: a state that is no longer physical stops it. The message names step, grain,
// place and remedy.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/base/clock.hpp"
#include "engine/measure/observers.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

struct HealthLimits {
    Clock clock;
    double overlap = 1.0 / 3.0;        // largest overlap, as a share of the smaller radius
    std::vector<std::string> species;  // names, for messages
    double safe_speed = std::numeric_limits<double>::infinity();       // m/s, relative speed of two grains:
                                                                       // no impact below it overlaps so far
    double smallest_radius = std::numeric_limits<double>::infinity();  // m
    double wall_speed = 0;     // m/s, speed of the fastest wall with a motion of its own
    std::int32_t vessel = -1;  // number of the mesh that is closed around all grains, or -1
};

HealthLimits health_limits(const Scene& scene, const Plan& plan);

// Throws RunError if a grain has a value that is not finite, has left the container, overlaps too far, or is
// so fast that it may pass another between two steps.
void check_state(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                 const StepLoop& loop, std::int64_t step);
// The same where `show` shows the contacts, of which only the two bodies, overlap and smaller radius count.
void check_state(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                 const ShowContacts& show, std::int64_t step);

// Number of steps until the next look, such that no impact that overlaps too far begins and ends unseen.
// There are many if the speeds are safe.
std::int64_t steps_to_next_look(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                                std::int64_t step);

// The message for grains that gained energy (J) which no wall gave them; it names the fastest.
std::string energy_gained_text(const HealthLimits& limits, const Grains& grains, std::int64_t step,
                               double gained, const std::string& beside);

// Watches the energy balance: without work done on them, grains can only lose energy.
class EnergyWatch {
  public:
    // All values are in J. `energy` is the total energy, `work` the work done by walls so far, and `through`
    // the sum of the magnitudes of all terms of both. Throws RunError if energy - work has risen too far
    // above its lowest value so far. The limit is 5 % of the energy that was turned over and of the present
    // motion, plus `allowance`, plus the possible rounding of the largest sum so far.
    void check(double energy, double work, double through, double allowance, const HealthLimits& limits,
               const Grains& grains, std::int64_t step);

  private:
    double lowest_ = std::numeric_limits<double>::infinity();
    double first_ = std::numeric_limits<double>::quiet_NaN();
    double work_done_ = 0;
    double largest_through_ = 0;
};

}  // namespace grainreel
