// Checks the health of a run: a state that is no longer physical stops it. The message names step, grain,
// place and remedy.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/base/numbers.hpp"
#include "engine/measure/deepest_contact.hpp"
#include "engine/measure/observers.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

struct HealthLimits {
    Clock clock;
    double overlap = 1.0 / 3.0;        // largest overlap, as a share of the smaller radius
    double planned = 1.0 / 3.0;        // largest overlap that the plan expects, as such a share
    std::vector<std::string> species;  // names, for messages
    double safe_speed = std::numeric_limits<double>::infinity();       // m/s, relative speed of two grains:
                                                                       // impacts below it do not reach
                                                                       // `overlap`
    double smallest_radius = std::numeric_limits<double>::infinity();  // m
    double wall_speed = 0;     // m/s, speed of the fastest wall with a motion of its own
    std::int32_t vessel = -1;  // number of the mesh that is closed around all grains, or -1

    // Larger overlaps are told: those above twice what the plan expects, and those above a tenth of a radius
    // where the plan expects less.
    double told() const { return std::max(planned, std::min(2 * planned, 0.1)); }
};

HealthLimits health_limits(const Scene& scene, const Plan& plan);

// Throws RunError if a grain has a value that is not finite, has left the container, overlaps too far, or is
// so fast that it may pass another between two steps. Returns the contact that overlaps most.
DeepestContact check_state(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                           const StepLoop& loop, std::int64_t step);
// The same with contacts that `show` shows. Only their two bodies, overlap and smaller radius are read.
DeepestContact check_state(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                           const ShowContacts& show, std::int64_t step);

// The contact that overlaps most.
DeepestContact deepest_contact(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                               const ShowContacts& show, std::int64_t step);

// What helps where a wall of its own motion presses on a grain; `pressing_wall` is as wall_name() gives it.
// Empty without one.
std::string advice_against_press(const std::string& pressing_wall);

// "grain 3 (aa) overlaps the floor by 0.3 of the smaller radius at 0.12 s, where ... are planned; remedy",
// for an overlap above limits.told(); else empty.
std::string overlap_text(const HealthLimits& limits, const DeepestContact& deepest);

// Number of steps until the next look, so short that no impact that overlaps too far begins and ends unseen.
// While all speeds are safe, the next look is at the next multiple of 200 steps.
std::int64_t steps_to_next_look(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                                std::int64_t step);

// The message that the grains gained an energy (`gained`, J) which no wall gave them. It names the fastest
// grain; `beside` stands in it in brackets.
std::string energy_gained_text(const HealthLimits& limits, const Grains& grains, std::int64_t step,
                               double gained, const std::string& beside);

// Watches the energy balance: without work done on them, grains can only lose energy.
class EnergyWatch {
  public:
    // All values are in J. `energy` is the total energy, `work` the work done by walls so far, and `through`
    // the sum of the magnitudes of all terms of energy and work. Throws RunError if energy - work has risen
    // too far above its lowest value so far. The limit is 5 % of the sum of two energies, plus `allowance`,
    // plus the possible rounding of the largest `through` so far. One is the energy turned over so far (the
    // largest fall of energy - work or the largest work); the other is the present kinetic energy.
    void check(double energy, double work, double through, double allowance, const HealthLimits& limits,
               const Grains& grains, std::int64_t step);

  private:
    double lowest_ = std::numeric_limits<double>::infinity();
    double first_ = kUnknown;
    double work_done_ = 0;
    double largest_through_ = 0;
};

}  // namespace grainreel
