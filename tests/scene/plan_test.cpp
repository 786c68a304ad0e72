// Tests of the plan against formulas worked out by hand, one condition at a time.
#include "engine/plan/plan.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/plan/plan_parts.hpp"
#include "engine/scene/bed.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;
using test::tells;
using test::tells_only;
using testing::HasSubstr;

double sphere_mass(double diameter, double density) {
    return density * pi / 6 * diameter * diameter * diameter;
}

// ---- the bed ----

TEST(Bed, FillHeightFollowsTheWedge) {
    FilmedScene scene = read_text(wedge_text);
    const Container& c = scene.container;
    const double area_above = c.depth * 2 * c.half_width;
    const double volume_slanted = c.depth * c.slant_height * (c.floor_half_width() + c.half_width);
    // The bed ends 10 mm above the slanted part.
    const double grain = pi / 6 * std::pow(0.005, 3);
    scene.species.resize(1);
    scene.species[0].count = static_cast<std::int64_t>((volume_slanted + 0.01 * area_above) * 0.6 / grain);
    EXPECT_NEAR(fill_height(scene, 0.6), c.slant_height + 0.01, grain / 0.6 / area_above);
    // This bed ends within the slanted part: the volume below its height is that of the bed.
    scene.species[0].count /= 3;
    const double h = fill_height(scene, 0.6);
    const double width = c.floor_half_width() + c.half_width_at(h);
    EXPECT_LT(h, c.slant_height);
    EXPECT_NEAR(c.depth * h * width, static_cast<double>(scene.species[0].count) * grain / 0.6, 1e-12);
}

TEST(Bed, MeanCubeOfSpreads) {
    SizeSpread uniform{SizeSpread::Kind::uniform, 1, 3, 2, 0};
    EXPECT_DOUBLE_EQ(mean_cube(uniform), (81.0 - 1.0) / 4 / 2);  // integral of x^3 from 1 to 3, over 2
    SizeSpread normal{SizeSpread::Kind::normal, 1.4, 2.6, 2, 0.3};
    double weight = 0, sum = 0;  // by numerical integration
    for (int i = 0; i < 200000; ++i) {
        const double z = -2 + 4 * (i + 0.5) / 200000;
        const double density = std::exp(-z * z / 2);
        weight += density;
        sum += density * std::pow(2 + 0.3 * z, 3);
    }
    EXPECT_NEAR(mean_cube(normal), sum / weight, 1e-8);
}

// ---- stiffness ----

const std::string drive_text = "[drive]\nfrequency = \"20 Hz\"\ng_level = 3\n";

// The bed is deep and driven hard: the plate meets a plastic block at 2.2 a omega.
const std::vector<std::string> deep_and_hard = {"contact.restitution=0.5", "run.duration=0.5",
                                                "drive.g_level=20", "species.small.count=1500",
                                                "contact.friction=0"};

TEST(PlanStiffness, ImpactBinds) {
    const FilmedScene scene = read_text(wedge_text, deep_and_hard);
    const Plan plan = make_plan(scene);
    const double speed = 2.2 * scene.drive.amplitude * 2 * pi * 20;
    EXPECT_NEAR(plan.impact_speed, speed, 0.01 * speed);
    const double m = sphere_mass(0.005, 2500);
    EXPECT_DOUBLE_EQ(plan.between(0, 0).loading_stiffness,
                     m / 2 * std::pow(plan.impact_speed / (0.01 * 0.005), 2));
    EXPECT_EQ(plan.between(0, 0).stiffness_reason, "impact");
    // A small grain meets a big one: the smaller diameter counts, and the effective mass of 1 and 8 parts.
    EXPECT_DOUBLE_EQ(plan.between(0, 1).loading_stiffness,
                     m * 8 / 9 * std::pow(plan.impact_speed / (0.01 * 0.005), 2));
    EXPECT_DOUBLE_EQ(plan.wall[0].loading_stiffness, m * std::pow(plan.impact_speed / (0.01 * 0.005), 2));
    EXPECT_EQ(plan.between(1, 0).loading_stiffness, plan.between(0, 1).loading_stiffness);
    // A big grain's mass lies on three small ones, while the softest contact is made for half a small one's
    // mass.
    EXPECT_NEAR(plan.expected_overlap, 0.01 * std::sqrt(8.0 / 3 / 0.5), 1e-12);
}

TEST(PlanStiffness, StaticLoadBindsUnderADeepHeavyBed) {
    // There is no drive and the overlap is small; the fall while settling may still reach 0.05.
    const FilmedScene scene =
        read_text(with(wedge_text, drive_text, ""), {"species.small.count=2000", "run.overlap=0.002"});
    const Plan plan = make_plan(scene);
    const double carried = std::min(plan.bed_height, 2 * scene.container.depth);
    EXPECT_DOUBLE_EQ(plan.between(0, 0).loading_stiffness, 3 * 0.6 * 2500 * 10 * carried * 0.005 / 0.002);
    EXPECT_EQ(plan.between(0, 0).stiffness_reason, "static load");
}

TEST(PlanStiffness, WaveBindsWithManyLayersAndAHighFrequency) {
    const FilmedScene scene =
        read_text(wedge_text, {"species.small.count=3500", "drive.frequency=400", "drive.g_level=2"});
    const Plan plan = make_plan(scene);
    EXPECT_EQ(plan.between(0, 0).stiffness_reason, "wave");
    // t_c = 0.1 d / (f h)
    EXPECT_NEAR(plan.between(0, 0).contact_time, 0.1 * 0.005 / (400 * plan.bed_height), 1e-12);
}

TEST(PlanStiffness, SettlingMayBeSofter) {
    // Without a drive only the fall counts, at the looser limit of 0.05.
    const FilmedScene scene = read_text(with(wedge_text, drive_text, ""));
    const Plan plan = make_plan(scene);
    EXPECT_DOUBLE_EQ(plan.impact_speed, std::sqrt(2 * 10 * (0.18 - plan.bed_height)) * 0.01 / 0.05);
    EXPECT_EQ(plan.clock.steps_per_period, 0);
}

TEST(PlanStiffness, AShallowBedIsThrownHigherThanADeepOne) {
    const FilmedScene one = read_text(wedge_text, {"species.small.count=1", "species.big.count=1"});
    const double e = 0.8;
    const double speed = make_plan(one).impact_speed / one.drive.speed();
    EXPECT_NEAR(speed, 3 * std::sqrt((1 + e) / (2 * (1 - e))), 1e-12);
}

TEST(PlanStiffness, TheSceneHasTheLastWord) {
    const Plan plan =
        make_plan(read_text(wedge_text, {"contact.stiffness=1e5", "contact.wall.stiffness=3e5"}));
    EXPECT_EQ(plan.between(0, 1).loading_stiffness, 1e5);
    EXPECT_EQ(plan.between(0, 1).stiffness_reason, "the scene");
    EXPECT_EQ(plan.wall[0].loading_stiffness, 3e5);
}

// The scene may give the stiffness in general, for a pair, or for both kinds of contact in one.
TEST(PlanStiffness, OfGluedGrains) {
    const std::string rough =
        with(wedge_text, "height = \"180 mm\"\n",
             "height = \"180 mm\"\nwall_grains = { species = \"big\", faces = [\"floor\"] }\n");
    const auto glued = [&](const std::string& more, const Assignments& sets) {
        const Plan plan = make_plan(read_text(rough + more, sets));
        return std::vector{plan.glued[0].loading_stiffness, plan.glued[1].loading_stiffness,
                           plan.between(0, 1).loading_stiffness, plan.wall[0].loading_stiffness};
    };
    const std::string pair = "[[contact.pair]]\nbetween = [\"big\", \"small\"]\nglued_stiffness = 3e4\n";
    const std::vector<double> chosen = glued("", {});
    EXPECT_EQ(glued("", {"contact.glued_stiffness=2e4"}), (std::vector{2e4, 2e4, chosen[2], chosen[3]}));
    EXPECT_EQ(glued("", {"contact.stiffness=1e4"}), (std::vector{1e4, 1e4, 1e4, 1e4}));
    EXPECT_EQ(glued(pair, {"contact.glued_stiffness=2e4", "contact.stiffness=1e4"}),
              (std::vector{3e4, 2e4, 1e4, 1e4}));
    EXPECT_EQ(glued(pair, {}), (std::vector{3e4, chosen[1], chosen[2], chosen[3]}));
    const Plan hertz = make_plan(read_text(rough, {"contact.law=hertz", "contact.glued_modulus=20 MPa"}));
    for (const PairPlan& contact : hertz.glued) EXPECT_EQ(contact.modulus, 2e7);
    EXPECT_EQ(hertz.between(0, 1).modulus,
              make_plan(read_text(rough, {"contact.law=hertz"})).between(0, 1).modulus);
}

TEST(PlanStiffness, WaltonBraunBranches) {
    const Plan plan =
        make_plan(read_text(wedge_text, {"contact.stiffness=1e4", "contact.tangential_ratio=0.7"}));
    const PairPlan& pair = plan.between(0, 0);
    const double m = sphere_mass(0.005, 2500) / 2;
    EXPECT_DOUBLE_EQ(pair.effective_mass, m);
    EXPECT_DOUBLE_EQ(pair.unloading_stiffness, 1e4 / 0.64);
    EXPECT_DOUBLE_EQ(pair.tangential_stiffness, 7e3);
    EXPECT_DOUBLE_EQ(pair.contact_time, pi / 2 * 1.8 * std::sqrt(m / 1e4));
    EXPECT_DOUBLE_EQ(pair.allowed_overlap, 0.01 * 0.005);
    EXPECT_EQ(pair.normal_damping, 0);
}

// e(v) = sqrt(w0 / (w0 + S v)). The scene's value holds at the speed that it names, and the step uses the
// value at v*.
TEST(PlanContact, HardeningFollowsFromTheRestitutionAtOneSpeed) {
    const FilmedScene scene =
        read_text(wedge_text, {"contact.stiffness=1e4", "contact.restitution_speed=\"20 cm/s\""});
    const Plan plan = make_plan(scene);
    const PairPlan& pair = plan.between(0, 0);
    const double natural = std::sqrt(1e4 / (sphere_mass(0.005, 2500) / 2));
    EXPECT_EQ(pair.model.normal, NormalForce::walton_braun_speed);
    EXPECT_DOUBLE_EQ(std::sqrt(natural / (natural + pair.hardening * 0.2)), 0.8);
    EXPECT_DOUBLE_EQ(pair.restitution, std::sqrt(natural / (natural + pair.hardening * plan.impact_speed)));
    EXPECT_LT(pair.restitution, 0.8) << "v* is above 0.2 m/s";
    EXPECT_DOUBLE_EQ(pair.unloading_stiffness, 1e4 / (pair.restitution * pair.restitution));
    EXPECT_EQ(make_plan(read_text(wedge_text)).grain[0].model.normal, NormalForce::walton_braun_corrected);
}

// What the corrections gain matters where an impact loses almost nothing; there the spring runs without them.
TEST(PlanContact, NearlyElasticContactsAreNotCorrected) {
    const auto law = [](double e) {
        return make_plan(read_text(wedge_text, {fmt::format("contact.restitution={}", e)}))
            .grain[0]
            .model.normal;
    };
    const double limit = std::sqrt(1 - std::pow(pi / 12, 4));
    EXPECT_EQ(law(limit - 1e-6), NormalForce::walton_braun_corrected);
    EXPECT_EQ(law(limit + 1e-6), NormalForce::walton_braun);
    EXPECT_EQ(law(1), NormalForce::walton_braun);
}

// ---- the spring-dashpot ----

TEST(PlanDamping, RestitutionFollowsFromDamping) {
    // This is the bed with which other engines are measured: kn 1000 N/m, 2634 1/s, 1 mm and 2 mm grains.
    const Plan plan = make_plan(read_text(box_text, {"contact.attraction=true"}));
    const double m = sphere_mass(0.001, 2500);
    const auto restitution = [](double effective_mass) {
        const double beta = 2634 / (2 * std::sqrt(1000 / effective_mass));
        return std::exp(-pi * beta / std::sqrt(1 - beta * beta));
    };
    EXPECT_DOUBLE_EQ(plan.between(0, 0).restitution, restitution(m / 2));
    EXPECT_DOUBLE_EQ(plan.between(1, 1).restitution, restitution(4 * m));
    EXPECT_DOUBLE_EQ(plan.wall[0].restitution, restitution(m));
    EXPECT_DOUBLE_EQ(plan.between(0, 0).tangential_damping, 1317);
    EXPECT_DOUBLE_EQ(plan.between(0, 0).tangential_stiffness, 2000.0 / 7);
    EXPECT_EQ(plan.between(0, 0).unloading_stiffness, 1000);
    EXPECT_EQ(plan.grain[0].model.tangential, TangentialLaw::linear_spring);
}

TEST(PlanDamping, DampingFollowsFromRestitution) {
    const FilmedScene scene =
        read_text(with(box_text, "normal_damping = 2634", "restitution = 0.6"), {"contact.attraction=true"});
    const PairPlan pair = make_plan(scene).grain[0];
    const double natural = std::sqrt(1000 / (sphere_mass(0.001, 2500) / 2));
    const double beta = pair.normal_damping / (2 * natural);
    EXPECT_NEAR(std::exp(-pi * beta / std::sqrt(1 - beta * beta)), 0.6, 1e-14);
    EXPECT_NEAR(pair.contact_time, pi / (natural * std::sqrt(1 - beta * beta)), 1e-18);
    EXPECT_EQ(make_plan(read_text(with(box_text, "normal_damping = 2634", "restitution = 1")))
                  .grain[0]
                  .normal_damping,
              0);
}

// ---- the step ----

// The error of the restitution of Walton-Braun's spring by plain velocity Verlet with n steps a contact; the
// worst of 200 onsets.
double worst_restitution_error(double restitution, int steps) {
    const double stiffness = 1, mass = 1;
    const double unloading = stiffness / (restitution * restitution);
    const double dt = pi / 2 * (1 + restitution) / steps;
    double worst = 0;
    for (int phase = 0; phase < 200; ++phase) {
        double x = -(phase + 0.5) / 200 * dt, v = 1, largest = 0, force = 0;
        for (int i = 0; i < 50 * steps && !(v < 0 && force == 0); ++i) {
            v -= force / mass * dt / 2;
            x += v * dt;
            largest = std::max(largest, x);
            const double residual = largest * (1 - stiffness / unloading);
            force = std::max(0.0, std::min(stiffness * x, unloading * (x - residual)));
            v -= force / mass * dt / 2;
        }
        worst = std::max(worst, std::abs(-v - restitution));
    }
    return worst;
}

TEST(PlanStep, StepsPerContactKeepTheRestitution) {
    for (double e = 0.08; e <= 1; e += 0.02) {
        const int steps = steps_per_contact(NormalForce::walton_braun, e);
        EXPECT_LE(worst_restitution_error(e, steps), 0.005) << "e = " << e << ", n = " << steps;
    }
    EXPECT_EQ(steps_per_contact(NormalForce::walton_braun, 0.9), 12);
    EXPECT_EQ(steps_per_contact(NormalForce::walton_braun, 1),
              steps_per_contact(NormalForce::spring_dashpot, 1));
    EXPECT_GT(worst_restitution_error(0.3, 12), 0.005);  // one number of steps for all would not do
}

TEST(PlanStep, ContactTimeBindsForSmoothGrains) {
    const Plan plan = make_plan(read_text(wedge_text, {"contact.friction=0", "contact.stiffness=1e4"}));
    const PairPlan& pair = plan.between(0, 0);
    EXPECT_FALSE(plan.rubs());
    EXPECT_EQ(plan.step_reason, "12 steps in a contact small-small");
    const double wanted = pair.contact_time / 12;
    EXPECT_LE(plan.clock.step, wanted);
    EXPECT_GT(plan.clock.step,
              wanted / (1 + 8 * 20 * wanted));  // rounding changes the count by less than 8 steps a period
}

TEST(PlanStep, TheDenseBedBindsForStiffTangentialSprings) {
    const FilmedScene scene =
        read_text(box_text, {"contact.tangential_ratio=1.5", "run.steps_per_contact=8"});
    const Plan plan = make_plan(scene);
    EXPECT_EQ(plan.step_reason, "stability of \"a\" among twelve neighbours");
    EXPECT_DOUBLE_EQ(plan.clock.step, 1.2 / std::sqrt(40 * 1500 / sphere_mass(0.001, 2500)));
}

TEST(PlanStep, StiffUnloadingBinds) {
    const FilmedScene scene =
        read_text(with(box_text, "law = \"spring-dashpot\"\nstiffness = 1000\nnormal_damping = 2634\n",
                       "restitution = 0.1\nstiffness = 1000\n"),
                  {"run.steps_per_contact=4", "contact.friction=0", "species.b.count=1"});
    const Plan plan = make_plan(scene);
    const double unloading = std::sqrt(1e5 / (sphere_mass(0.001, 2500) / 2));
    const double dense = std::sqrt(8e5 / sphere_mass(0.001, 2500));
    EXPECT_DOUBLE_EQ(plan.clock.step, std::min(pi / 2 / 2.75 / unloading, 1.2 / dense));
    EXPECT_LT(plan.clock.step, plan.between(0, 0).contact_time / 4);
}

TEST(PlanStep, AMultipleOfEightMakesAPeriod) {
    for (const char* frequency : {"20 Hz", "7.3 Hz", "33.3 Hz", "120 Hz"}) {
        const FilmedScene scene = read_text(wedge_text, {std::string("drive.frequency=") + frequency});
        const Plan plan = make_plan(scene);
        EXPECT_EQ(plan.clock.steps_per_period % 8, 0) << frequency;
        EXPECT_NEAR(
            plan.clock.step * static_cast<double>(plan.clock.steps_per_period) * scene.drive.frequency, 1,
            1e-14);
        EXPECT_EQ(plan.steps, std::llround(2 / plan.clock.step));
        EXPECT_EQ(plan.trajectory_every, plan.clock.steps_per_period);
        EXPECT_EQ(plan.measures_every * 8, plan.clock.steps_per_period);
        EXPECT_EQ(plan.settle_steps_limit, std::llround(5 / plan.clock.step));
    }
}

TEST(PlanStep, GivenIntervalsAndStep) {
    const Plan plan = make_plan(read_text(
        box_text, {"run.step=1e-6", "output.trajectory_interval=1 ms", "output.measures_interval=2.5e-5"}));
    EXPECT_EQ(plan.clock.step, 1e-6);
    EXPECT_EQ(plan.steps, 100000);
    EXPECT_EQ(plan.trajectory_every, 1000);
    EXPECT_EQ(plan.measures_every, 25);
    EXPECT_EQ(make_plan(read_text(box_text, {"output.trajectory=false"})).trajectory_every, 0);
}

// ---- warnings ----

std::string warnings(const std::string& text, const std::vector<std::string>& sets) {
    std::string all;
    for (const std::string& line : plan_with_film(read_text(text, sets)).warnings) all += line + "\n";
    return all;
}

TEST(PlanWarnings, AGoodSceneHasNone) {
    EXPECT_EQ(warnings(wedge_text, {"species.small.count=1000"}), "");
}

TEST(PlanWarnings, WordForWord) {
    const std::vector<std::string> deep = {"species.small.count=1000"};
    const auto of = [&](const std::string& set) {
        std::vector<std::string> sets = deep;
        sets.push_back(set);
        return warnings(wedge_text, sets);
    };
    EXPECT_THAT(of("drive.g_level=0.9"),
                tells_only({"test.toml:23:2", "g_level is 0.9", "below 1", "raise g_level"}));
    EXPECT_THAT(of("drive.ramp=50"),
                tells_only({"--set drive.ramp", "2.5 s", "run of 2 s", "shorten the ramp"}));
    EXPECT_THAT(
        warnings(wedge_text, {"species.small.count=1000", "contact.restitution=1", "contact.friction=0"}),
        tells_only({"test.toml:13:2", "restitution 1", "no energy", "lower it"}));
    EXPECT_THAT(of("run.step=1e-4"), tells({" s", "above", "stable limit"}));
    EXPECT_THAT(of("run.step=3e-5"), tells({"12 are wanted", "restitution 0.8", "shorten the step"}));
    EXPECT_THAT(of("contact.stiffness=100"), tells({"diameter", "most contacts", "0.05"}));
    EXPECT_THAT(of("contact.stiffness=100"), tells({"period", "cross the bed"}));
    EXPECT_THAT(of("contact.stiffness=0.1"), HasSubstr("may pass through each other"));
    EXPECT_THAT(of("species.small.diameter=0.9 mm"), HasSubstr("11.1 times the smallest"));
}

// These failures are not seen by any health check (docs/reference/stability.md).
TEST(PlanWarnings, OfSilentFailures) {
    const auto of = [&](std::vector<std::string> sets) {
        sets.insert(sets.begin(), "species.small.count=1000");
        return warnings(wedge_text, sets);
    };
    EXPECT_EQ(
        of({"drive.ramp=0"}),
        fmt::format("--set drive.ramp: without a ramp the drive starts at {:.3g} m/s and kicks the bed; "
                    "take a ramp of 3 periods, or a phase of 90 deg\n",
                    3 * 10 / (2 * pi * 20)));
    EXPECT_EQ(of({"drive.ramp=0", "drive.phase=90 deg"}), "");
    EXPECT_THAT(of({"contact.arms=radius"}),
                tells_only({"--set contact.arms", "lever arm", "ratcheting", "leave it out"}));
    EXPECT_EQ(of({"contact.arms=radius", "contact.friction=0"}).find("ratcheting"), std::string::npos);

    const Plan soft = make_plan(read_text(wedge_text, {"contact.stiffness=20"}));
    const std::string said = of({"contact.stiffness=20"});
    // The largest number of wall contacts: a species has as many as its surface has room for.
    const double small = 1000 * 25.0, big = 10 * 100.0;
    const double lasts =
        20 * (small * soft.wall[0].contact_time + big * soft.wall[1].contact_time) / (small + big);
    EXPECT_THAT(said,
                HasSubstr(fmt::format("a contact lasts {:.2g} of a period, in which what is shaken changes "
                                      "its speed by {:.2g} of the largest",
                                      lasts, 2 * pi * lasts)));
    EXPECT_THAT(said, tells({"too little energy", "detachment", "raise the stiffness"}));
    EXPECT_THAT(of({"contact.stiffness=2e12"}), tells({"rounding", "noise", "lower the stiffness"}));
}

TEST(PlanWarnings, TheStableStepIsThatOfTheIntegrator) {
    const double fastest = std::sqrt(8 * 1000 / sphere_mass(0.001, 2500));
    const std::string between =
        fmt::format("run.step={}", 1.6 / fastest);  // lies between the limits 1.41 of Gear and 2 of Verlet
    const auto of = [&](const char* integrator) {
        return warnings(box_text, {std::string("run.integrator=") + integrator, between, "contact.friction=0",
                                   "contact.normal_damping=0"});
    };
    EXPECT_THAT(of("gear"), HasSubstr("is above the stable limit"));
    EXPECT_EQ(of("velocity-verlet").find("is above the stable limit"), std::string::npos);
}

TEST(PlanWarnings, AFilmThatEndsBeforeTheRun) {
    EXPECT_THAT(warnings(wedge_text + "[[film.segment]]\nduration = 0.5\n", {}),
                tells({"test.toml:28:8", "0.5 s of 2 s", "leave out"}));
}

TEST(PlanWarnings, APlotOfAColumnThatStaysEmpty) {
    const std::string plot = "[[film.plot]]\ny = \"repose_angle_degree\"\n";
    EXPECT_THAT(warnings(wedge_text + plot, {}), tells({"test.toml:29:1", "'repose_angle_degree'", "empty",
                                                        "nothing turns", "another column"}));
    EXPECT_EQ(warnings(wedge_text + "[[film.plot]]\ny = \"bed_top_m\"\n", {}), warnings(wedge_text, {}));
}

}  // namespace
}  // namespace grainreel
