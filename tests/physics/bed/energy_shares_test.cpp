// Tests of the energy balance as an instrument of a run: its terms add up to what is lost, at any number of
// threads and when a run is resumed.
#include "engine/measure/energy_observers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/measure/columns.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/restart.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

Scene scene_of() {
    const std::vector<std::string> sets{"output.instruments=[\"energy_balance\"]",
                                        "start.settle_limit=0.02 s"};
    return read_scene_text(test::small_scene_text, "shares.toml", with_tested_precision(sets), measurable_in);
}

TEST(EnergyShares, AddUpToWhatIsLost) {
    const Scene scene = scene_of();
    const Plan plan = make_plan(scene);
    SimulatedBed run(scene, plan, 1);
    run.pack();
    run.advance(plan.clock.steps_per_period);
    const Measures m = run.measures();
    const double sum = m.at("latching_J") + m.at("friction_J") + m.at("damping_J");
    EXPECT_GT(m.at("latching_J"), 0);
    EXPECT_GT(m.at("friction_J"), 0);
    EXPECT_EQ(m.at("damping_J"), 0);  // no dashpots here
    // wall_work_J counts the last force for a whole step, and the balance counts it for half a step. At this
    // moment the bed pushes with at most a few times its weight.
    double weight = 0;
    for (const Species& species : scene.species)
        weight += static_cast<double>(species.count) * species.density * std::numbers::pi / 6 *
                  std::pow(species.diameter.mean, 3) * 9.81;
    const double speed = 2 * std::numbers::pi * scene.drive.frequency * scene.drive.amplitude;
    EXPECT_NEAR(m.at("lost_J"), sum - m.at("balance_error_J"), 5 * weight * speed * plan.clock.step);
    EXPECT_LT(std::abs(m.at("balance_error_J")), 0.02 * sum);
}

TEST(EnergyShares, AreTheSameBitsWhenTakenUp) {
    const test::TemporaryFolder here;
    const Scene scene = scene_of();
    const Plan plan = make_plan(scene);
    SimulatedBed first(scene, plan, 1);
    first.pack();
    first.advance(333);
    first.save_checkpoint(here / "a.grs");
    first.advance(700);
    for (const int threads : {1, 3}) {
        const Scene next = continued(scene, here / "a.grs");
        SimulatedBed taken_up(next, plan, threads);
        taken_up.pack();
        taken_up.advance(700);
        EXPECT_EQ(taken_up.measures().values(), first.measures().values()) << threads;
    }
}

}  // namespace
}  // namespace grainreel
