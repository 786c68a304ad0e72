// Tests of conditions under which methods fail: limits against their formulas, and the health check that
// stops a run beyond them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/base/error.hpp"
#include "engine/lab/chart/limits/stability.hpp"
#include "engine/measure/health.hpp"
#include "engine/plan/plan_parts.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/chapters/words.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using testing::AllOf;
using testing::HasSubstr;

// ---- the chart's experiments against formulas ----

Finding found(const std::string& name) {
    for (const Experiment& experiment : stability_experiments())
        if (experiment.name == name) return experiment.run(true);
    throw std::logic_error("no experiment '" + name + "'");
}

double value_at(const Finding& finding, double x) {
    const auto nearer = [x](const CurvePoint& a, const CurvePoint& b) {
        return std::abs(a.x - x) < std::abs(b.x - x);
    };
    return std::min_element(finding.curve.begin(), finding.curve.end(), nearer)->value;
}

TEST(StabilityChart, EveryExperimentHasItsOwnNameAndFitsATable) {
    std::set<std::string> names;
    for (const Experiment& e : stability_experiments()) {
        EXPECT_TRUE(names.insert(e.name).second) << e.name;
        EXPECT_EQ((e.name + e.varied + e.guard).find(','), std::string::npos) << e.name;
        EXPECT_NE(e.guard, "") << e.name;
    }
    EXPECT_GE(names.size(), 40u);
}

// The limit is 2 / omega for Verlet, sqrt 2 / omega for Gear's four values, and given by the amplification
// matrix for Omelyan's scheme. The soft plates add a hundredth of K to the 2 K of a pair.
TEST(StabilityChart, APairsLongestStepIsThatOfItsIntegrator) {
    const double softened = std::sqrt(2 + 0.01);
    for (const char* name : {"velocity-verlet", "leapfrog", "position-verlet"})
        EXPECT_NEAR(found(std::string("step: pair by ") + name).measured, 2 / softened, 1e-3) << name;
    EXPECT_NEAR(found("step: pair by gear").measured, std::sqrt(2.0) / softened, 4e-3);
    const double omelyan = stability_limit(Integrator::forest_ruth);
    EXPECT_NEAR(found("step: pair by forest-ruth").measured, omelyan / softened, 1e-3);
    EXPECT_NEAR(growth_a_step(Integrator::forest_ruth, 0.999 * omelyan), 1, 1e-9);
    EXPECT_GT(growth_a_step(Integrator::forest_ruth, 1.01 * omelyan), 1.01);
}

TEST(StabilityChart, ThePlanKnowsEachIntegratorsLimit) {
    for (const auto& [word, integrator] : integrator_words)
        EXPECT_NEAR(stable_step(integrator), stability_limit(integrator), 2e-3) << word;
}

TEST(StabilityChart, SpringsInARowAndACrystalAllowLess) {
    EXPECT_NEAR(found("step: chain of 20").measured, 1 / std::cos(std::numbers::pi / 42), 1e-3);
    EXPECT_NEAR(found("step: pair that unloads (e = 0.5)").measured, 2 / std::sqrt(8.01), 1e-3);
    EXPECT_NEAR(found("step: tangential spring (K0 = 0.8 K)").measured, 2 / std::sqrt(3.5 * 0.8), 3e-3);
    // An endless crystal has 2 / sqrt 8; a block of seven layers has no mode that is quite as fast.
    const double bed = found("step: dense bed (smooth)").measured;
    EXPECT_GT(bed, 2 / std::sqrt(8.0));
    EXPECT_LT(bed, 1.08 * 2 / std::sqrt(8.0));
}

TEST(StabilityChart, CentresCrossAtTheSpeedOfTheFormula) {
    const Finding tunnelling = found("tunnelling through a grain");
    EXPECT_NEAR(tunnelling.measured, 1, 1e-3);
    EXPECT_GT(value_at(tunnelling, 0.99), 0);
    EXPECT_LT(value_at(tunnelling, 1.01), 0);
    EXPECT_NEAR(found("through a wall").measured, 1, 1e-3);
    const Finding missed = found("past each other in one step");
    EXPECT_EQ(value_at(missed, 0.9), 0);
    EXPECT_NEAR(value_at(missed, 2), 0.5, 0.05);
}

TEST(StabilityChart, ListsHoldEveryTouchingPairAtAnySpeed) {
    EXPECT_EQ(found("lists of fast grains").measured, 1);
}

TEST(StabilityChart, ThePlansStepKeepsRestitutionAndMomentumAtAnyRatio) {
    for (const char* name : {"restitution 0.02 to 0.999", "size ratio 1 to 50", "mass ratio 1 to 1000"})
        EXPECT_LT(found(name).measured, 0.002) << name;
    EXPECT_LT(found("momentum at size ratios 1 to 50").measured, 1e-12);
    EXPECT_LT(found("slip at size ratios 1 to 50").measured, 1.2) << "as good as between equal grains";
    EXPECT_NEAR(found("12 steps a contact (e = 0.9)").measured, 0.0018, 0.0002);
}

TEST(StabilityChart, ObliqueImpactsNeverGainEnergy) {
    EXPECT_LE(found("friction 0 to 1e6").measured, 1);
    for (const char* place : {"grazing at a wall", "grazing in a corner"}) {
        EXPECT_LE(found(std::string(place) + " (e = 0.9)").measured, 1) << place;
        // Elastic impacts are within twice the error of the restitution.
        EXPECT_LE(found(std::string(place) + " (e = 1)").measured, 1 + 2 * 0.001) << place;
    }
    // cos[sqrt(3.5 K0/K1) (pi/2) (1 + e)]
    EXPECT_NEAR(found("sticking at friction 1e6").measured,
                std::cos(std::sqrt(3.5 * 0.8) * std::numbers::pi / 2 * 1.9), 0.01);
}

TEST(StabilityChart, ForcesGoRoundWithTheirContact) {
    EXPECT_LT(found("turning pair").measured, 1e-11);
    const Finding twist = found("twisting pair");
    for (const CurvePoint& p : twist.curve)  // angle^3 / 12 a step
        EXPECT_NEAR(p.value, std::pow(2 * std::numbers::pi, 3) / (12 * p.x * p.x), 0.1 * p.value) << p.x;
}

TEST(StabilityChart, ClosedLoopsOfEachLaw) {
    EXPECT_LT(found("closed loop of linear-spring").measured, 1e-6);
    EXPECT_LT(found("closed loop of mindlin").measured, 1e-6);
    const Finding mindlin = found("closed loop of mindlin");
    EXPECT_NEAR(value_at(mindlin, 10), 1 / std::sqrt(10.0) - 1, 1e-3);
    const Finding slip = found("closed loop of incremental-slip");
    EXPECT_GT(slip.measured, 0.005) << "it does make energy (Elata & Berryman 1996)";
    EXPECT_LT(slip.measured, 0.02);
    for (const CurvePoint& p : slip.curve) EXPECT_NEAR(p.value, p.theory, 1e-4) << p.x;
}

// Too much slip is counted: the integral of overlap x angle, which is pi/2 x overlap x swing here.
TEST(StabilityChart, EachKindOfArmsRatchetsOnOneKindOfCycle) {
    EXPECT_LT(found("ratcheting of a swinging pair (arms to the plane)").measured, 1e-4);
    EXPECT_NEAR(found("ratcheting of a swinging pair (arms of the radius)").measured, std::numbers::pi / 2,
                1e-3);
    EXPECT_NEAR(found("ratcheting of a rolling pair (arms to the plane)").measured, std::numbers::pi / 2,
                1e-3);
    EXPECT_LT(found("ratcheting of a rolling pair (arms of the radius)").measured, 1e-4);
}

TEST(StabilityChart, LongContactsLoseTooLittle) {
    for (const char* law : {"Walton-Braun", "dashpot"}) {
        const Finding detachment = found(std::string("detachment by ") + law);
        const double hard = detachment.curve.front().theory;
        EXPECT_NEAR(value_at(detachment, 0.02), hard, 0.02 * hard) << law;
        EXPECT_GT(value_at(detachment, 10), 3 * hard) << law;
        EXPECT_GT(detachment.measured, 0.5) << law;
        EXPECT_LT(detachment.measured, 3) << law;
    }
    const Finding column = found("soft column");
    EXPECT_NEAR(column.measured, column.theory, 0.01 * column.theory);
    const Finding plate = found("drive as fast as a contact");
    for (const CurvePoint& p : plate.curve) EXPECT_NEAR(p.value, p.theory, 0.01 * p.theory) << p.x;
}

TEST(StabilityChart, AKickWithoutRampAndWallsInTime) {
    EXPECT_NEAR(found("kick without ramp").measured, 0.9, 1e-3);  // e a omega
    EXPECT_LT(found("kick with a ramp of 3 periods").measured, 1e-3);
    EXPECT_NEAR(found("walls in a step").measured, 2, 0.1);
}

TEST(StabilityChart, RoundingReachesTheForceWhereItReachesTheOverlap) {
    for (const char* precision : {"single", "double"}) {
        const Finding rounding = found(std::string("rounding in ") + precision + " precision");
        EXPECT_GT(rounding.measured, 0.5 * rounding.theory) << precision;
        EXPECT_LT(rounding.measured, 3 * rounding.theory) << precision;
    }
}

// ---- the health check, in runs of scenes ----

// The message of the health check for a run; "" if the run reaches its end.
std::string complaint(const std::string& text, const std::vector<std::string>& sets = {}) {
    const Scene scene = read_scene_text(text, "test.toml", with_tested_precision(sets));
    const Plan plan = make_plan(scene);
    SimulatedBed simulation(scene, plan, 1);
    try {
        simulation.pack();
        simulation.advance(plan.steps);
    } catch (const RunError& error) {
        return error.what();
    }
    return "";
}

constexpr double kSoft = 100;  // N/m
double unit() {                // s, sqrt(m / K)
    return std::sqrt(sphere_mass() / kSoft);
}
std::string step_of(double units) {
    return fmt::format("run.step={}", units * unit());
}

const std::string ball = fmt::format(R"([[species]]
name = "ball"
diameter = "4 mm"
density = 2500
[contact]
restitution = 0.9
friction = 0
stiffness = {}
)",
                                     kSoft);

std::string shot(double speed, const std::string& target) {
    return "gravity = 0\n" + ball + "[container]\nshape = \"none\"\n" +
           fmt::format("[[grain]]\nposition = [0, 0, 0]\nvelocity = [{}, 0, 0]\n{}[run]\nduration = {}\n",
                       speed, target, 0.04 / speed);
}
const std::string other_ball = "[[grain]]\nposition = [\"5 mm\", 0, 0]\n";
const std::string plane = "[[wall]]\npoint = [\"3 mm\", 0, 0]\nnormal = [-1, 0, 0]\n";

TEST(StabilityHealth, StopsAPairWhoseStepIsTooLong) {
    const std::string pair = shot(0.02, other_ball);
    EXPECT_EQ(complaint(pair), "");
    for (const double speed : {0.020, 0.0203, 0.0207, 0.021})  // an error of the step is no alarm
        EXPECT_EQ(
            complaint(shot(speed, other_ball),
                      {"contact.restitution=1", "run.contact_corrections=false", "run.steps_per_contact=12"}),
            "")
            << speed;
    EXPECT_THAT(complaint(pair, {step_of(1.1 * std::sqrt(2.0))}),
                AllOf(HasSubstr("step "), HasSubstr("the grains gained"), HasSubstr("(ball) at ("),
                      HasSubstr("take a smaller run.step")));
    // This also holds for a run that ends before the first regular look.
    EXPECT_THAT(complaint(pair, {step_of(1.1 * std::sqrt(2.0)),
                                 fmt::format("run.duration={}", 100 * 1.1 * std::sqrt(2.0) * unit())}),
                HasSubstr("step 100"));
}

std::string column() {
    std::string text = ball + R"([container]
shape = "box"
width = "4.2 mm"
depth = "4.2 mm"
height = "100 mm"
[run]
duration = 1
)";
    for (int k = 0; k < 20; ++k)
        text += fmt::format("[[grain]]\nposition = [0, 0, {}]\n", 0.00201 + 0.004 * k);
    return text;
}

TEST(StabilityHealth, StopsAColumnWhoseStepIsTooLong) {
    EXPECT_EQ(complaint(column()), "");
    // From 0.80 on some columns gain energy by their rounding. Of twelve columns, a tenth of a micrometre
    // apart, none does at 0.80, three or four at 0.805, and all at 0.82.
    EXPECT_EQ(complaint(column(), {step_of(0.79)}), "");
    EXPECT_THAT(complaint(column(), {step_of(1.1)}),
                AllOf(HasSubstr("step "), HasSubstr("(ball) at ("), HasSubstr("take a smaller run.step")));
}

const std::string box_of_grains = test::SmallScene()
                                      .beads(80, "ball")
                                      .contacts("0.9", "0.4")
                                      .more("stiffness = 2000\n")
                                      .box("20 mm", "20 mm", "60 mm")
                                      .lasts("0.2")
                                      .text();

// A loose bed with losses stays stable a little longer than a crystal's 0.7 sqrt(m/K).
TEST(StabilityHealth, StopsABedWhoseStepIsTooLong) {
    EXPECT_EQ(complaint(box_of_grains), "");
    EXPECT_THAT(complaint(box_of_grains, {fmt::format("run.step={}", 1.2 * std::sqrt(sphere_mass() / 2000)),
                                          "start.settle_limit=0.5"}),
                AllOf(HasSubstr("step "), HasSubstr("(ball) at ("), HasSubstr("smaller run.step")));
}

TEST(StabilityHealth, StopsGrainsThatGoThroughEachOther) {
    const double crossing = 2 * kRadius * std::sqrt(2 * kSoft / sphere_mass());
    EXPECT_EQ(complaint(shot(0.1 * crossing, other_ball)), "") << "an overlap of a tenth of the diameter";
    // The run is stopped however short the contact is: from an overlap of a third of a radius to one that
    // begins and ends within a step.
    for (const double speed : {0.25, 0.5, 0.9, 1.1, 1.5})
        EXPECT_THAT(complaint(shot(speed * crossing, other_ball)),
                    AllOf(HasSubstr("grain 0 (ball) at ("), HasSubstr("overlaps grain 1"),
                          tells({"larger contact.stiffness", "smaller run.step"})))
            << speed;
}

TEST(StabilityHealth, StopsGrainsThatPassEachOtherWithinAStep) {
    EXPECT_THAT(complaint(shot(100, other_ball), {step_of(0.2)}),
                AllOf(HasSubstr("(ball) at ("), tells({"meet unseen", "smaller run.step"})));
}

TEST(StabilityHealth, StopsGrainsThatGoThroughAWall) {
    const double crossing = 2 * kRadius * std::sqrt(kSoft / sphere_mass());
    EXPECT_EQ(complaint(shot(0.1 * crossing, plane)), "");
    EXPECT_THAT(complaint(shot(1.1 * crossing, plane)),
                AllOf(HasSubstr("grain 0 (ball) at ("), HasSubstr("overlaps the wall 1"),
                      tells({"larger contact.wall.stiffness", "smaller run.step"})));
}

// The scene has the largest stiffness that is allowed. (Values that are no numbers are tested in
// HealthCheck.)
TEST(StabilityHealth, StopsWhatFliesApart) {
    EXPECT_THAT(
        complaint(shot(0.02, other_ball), {"contact.stiffness=1e30", "run.step=1e-3"}),
        AllOf(HasSubstr("(ball)"), HasSubstr("pass each other"), HasSubstr("; take a smaller run.step")));
}

// Looks cost time: at the speeds that the plan expects they are as rare as possible.
TEST(StabilityHealth, LooksOftenOnlyWhereGrainsAreTooFast) {
    const Scene scene = read_scene_text(box_of_grains, "test.toml",
                                        {"contact.stiffness=1e4", "drive.frequency=20", "drive.g_level=3"});
    const Plan plan = make_plan(scene);
    const HealthLimits limits = health_limits(scene, plan);
    Grains grains;
    grains.add(0, 0, Vec3(0, 0, 0.01), kRadius, kDensity);
    grains.add(1, 0, Vec3(0, 0, 0.02), kRadius, kDensity);
    const auto steps = [&](double speed) {
        grains.motion[1].velocity = Vec3(0, 0, -speed);
        return steps_to_next_look(limits, Surroundings(), grains, 1000);
    };
    EXPECT_EQ(steps(plan.impact_speed), 200);
    const double crossing = 2 * kRadius * std::sqrt(2e4 / sphere_mass());
    const std::int64_t few = steps(crossing);
    EXPECT_LT(few, 200);
    EXPECT_LT(static_cast<double>(few) * plan.clock.step * crossing, kRadius);
}

}  // namespace
}  // namespace grainreel
