// Tests of the error of the restitution that `check` promises, against impacts run as a user runs them.
#include "engine/lab/chart/accuracy/single_contact.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/plan/damping.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {
namespace {

constexpr double speed = 0.4;  // m/s

struct Setting {
    const char* name;
    const char* contact;  // lines of [contact]
    const char* run;      // lines of [run]
};

// A small ball flies at a large one, or at a plane, from a gap (m) before the touch.
Scene scene_of(const Setting& setting, bool wall, double gap) {
    const double reach = wall ? 0.002 : 0.005;
    return read_scene_text(
        fmt::format("gravity = 0\n"
                    "[[species]]\nname = \"a\"\ndiameter = \"4 mm\"\ndensity = 2500\n"
                    "[[species]]\nname = \"b\"\ndiameter = \"6 mm\"\ndensity = 7800\n"
                    "[contact]\n{}\n[container]\nshape = \"none\"\n"
                    "[[wall]]\npoint = [0, 0, {:.17g}]\nnormal = [0, 0, -1]\n"
                    "[[grain]]\nspecies = \"a\"\nposition = [0, 0, {:.17g}]\nvelocity = [0, 0, {}]\n"
                    "[[grain]]\nspecies = \"b\"\nposition = [0, 0, {}]\n"
                    "[run]\nduration = \"1 ms\"\n{}\n",
                    setting.contact, wall ? 0 : 1.0, -reach - gap, speed, wall ? -1 : 0, setting.run),
        "impact.toml");
}

// |e_measured - e| in one impact.
double error_of(const Setting& setting, bool wall, double phase, const Plan& plan, double restitution) {
    const Scene scene = scene_of(setting, wall, phase * speed * plan.clock.step);
    SimulatedBed simulation(scene, plan, 1);
    simulation.pack();
    const PairPlan& pair = wall ? plan.wall[0] : plan.between(0, 1);
    simulation.advance(static_cast<std::int64_t>(3 * pair.contact_time / plan.clock.step));
    const State end = simulation.frame();
    const double closing = end.velocity[0].z() - end.velocity[1].z();
    return std::abs(-closing / speed - restitution);
}

class PromisedError : public testing::TestWithParam<Setting> {};

TEST_P(PromisedError, IsKeptAtEveryOnset) {
    for (const bool wall : {false, true}) {
        const Scene scene = scene_of(GetParam(), wall, 0);
        const Plan plan = make_plan(scene);
        const PairPlan& pair = wall ? plan.wall[0] : plan.between(0, 1);
        const double promise =
            promised_restitution_error(plan, pair, scene.species[0], wall ? nullptr : &scene.species[1]);
        double worst = 0;
        for (int k = 0; k < 12; ++k)
            worst = std::max(worst, error_of(GetParam(), wall, (k + 0.37) / 12, plan, pair.restitution));
        EXPECT_LE(worst, std::stod(promised_error_text(promise))) << (wall ? "wall" : "grains");
    }
}

// The promise is not larger than needed: it is the worst of just those impacts.
TEST_P(PromisedError, IsThatOfTheWorstOnset) {
    const Scene scene = scene_of(GetParam(), false, 0);
    const Plan plan = make_plan(scene);
    const PairPlan& pair = plan.between(0, 1);
    double worst = 0;
    for (const double phase : promised_onsets())
        worst = std::max(worst, error_of(GetParam(), false, phase, plan, pair.restitution));
    EXPECT_NEAR(worst, promised_restitution_error(plan, pair, scene.species[0], &scene.species[1]),
                1e-6 + 1e-3 * worst);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, PromisedError,
    testing::Values(
        Setting{"Corrected", "restitution = 0.9", ""}, Setting{"CorrectedSoft", "restitution = 0.4", ""},
        Setting{"Mixed", "restitution = 0.9", "precision = \"mixed\""},
        Setting{"Plain", "restitution = 0.9", "contact_corrections = false"},
        Setting{"Draft", "restitution = 0.7", "accuracy = \"draft\""},
        Setting{"Leapfrog", "restitution = 0.8", "integrator = \"leapfrog\""},
        Setting{"PositionVerlet", "restitution = 0.8", "integrator = \"position-verlet\""},
        Setting{"ForestRuth", "restitution = 0.8", "integrator = \"forest-ruth\""},
        Setting{"Gear", "restitution = 0.8", "integrator = \"gear\""},
        Setting{"BySpeed", "restitution = 0.9\nrestitution_speed = \"0.2 m/s\"", ""},
        Setting{"ByTable", "restitution_table = [[0.1, 0.95], [1, 0.6]]", ""},
        Setting{"SpringDashpot", "law = \"spring-dashpot\"\nrestitution = 0.9", ""},
        Setting{"SpringDashpotPulls", "law = \"spring-dashpot\"\nrestitution = 0.9\nattraction = true", ""},
        Setting{"SpringDashpotPullsHard", "law = \"spring-dashpot\"\nrestitution = 0.5\nattraction = true",
                ""},
        Setting{"SpringDashpotReference", "law = \"spring-dashpot\"\nrestitution = 0.5\nattraction = true",
                "accuracy = \"reference\""},
        Setting{"SpringDashpotMixed", "law = \"spring-dashpot\"\nrestitution = 0.5", "precision = \"mixed\""},
        Setting{"Hertz", "law = \"hertz\"\nrestitution = 0.8", ""},
        Setting{"HertzPulls", "law = \"hertz\"\nrestitution = 0.8\nattraction = true", ""}),
    [](const auto& setting) { return setting.param.name; });

TEST(PromisedErrorText, IsRoundedUp) {
    EXPECT_EQ(promised_error_text(0.00411), "0.0042");
    EXPECT_EQ(promised_error_text(0.0041 / 1.01), "0.0041");
    EXPECT_EQ(promised_error_text(0.00986), "0.01");
    EXPECT_EQ(promised_error_text(0), "0");
    EXPECT_EQ(promised_error_text(std::nan("")), "-");
}

// The dashpot is found by secants and sixty halvings, most of which are known beforehand. The damping is the
// same, bit for bit, as by all halvings.
TEST(Dashpot, OfHertzIsThatOfPlainHalving) {
    for (const double e : {0.05, 0.3, 0.7, 0.9, 0.97, 0.999}) {
        double low = 0, high = 4 / e;
        for (int halving = 0; halving < 60; ++halving) {
            const double middle = 0.5 * (low + high);
            (hertz_restitution(middle, false) > e ? low : high) = middle;
        }
        EXPECT_EQ(hertz_damping(e, false), 0.5 * (low + high)) << e;
    }
}

}  // namespace
}  // namespace grainreel
