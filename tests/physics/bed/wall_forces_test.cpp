// Tests of forces on walls: against the momentum of the grains, against statics, and with any number of
// threads.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/measure/columns.hpp"
#include "engine/measure/walls/wall_faces.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/restart.hpp"
#include "engine/state/container_faces.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

Scene scene_of(const std::string& text, std::vector<std::string> sets = {}) {
    sets.push_back("output.instruments=[\"walls\"]");
    if (text == test::small_scene_text) sets.push_back("start.settle_limit=0.02 s");
    return read_scene_text(text, "walls.toml", with_tested_precision(sets), measurable_in);
}

Vec3 force_on(const Measures& m, const std::string& face) {
    return {m.at(face + "_force_x_N"), m.at(face + "_force_y_N"), m.at(face + "_force_z_N")};
}
Vec3 moment_on(const Measures& m, const std::string& face) {
    return {m.at(face + "_moment_x_N.m"), m.at(face + "_moment_y_N.m"), m.at(face + "_moment_z_N.m")};
}

Vec3 momentum(const Scene& scene, const State& frame) {
    Vec3 sum(0, 0, 0);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const double density = scene.species[static_cast<std::size_t>(frame.species[i])].density;
        sum += density * 4 / 3 * std::numbers::pi * std::pow(frame.radius[i], 3) * frame.velocity[i];
    }
    return sum;
}

double mass(const Scene& scene) {
    double sum = 0;
    for (const Species& species : scene.species)
        sum += static_cast<double>(species.count) * species.density * std::numbers::pi / 6 *
               std::pow(species.diameter.mean, 3);
    return sum;
}

class WallForces : public testing::TestWithParam<const char*> {};

// Only the grains' weight and the walls change their momentum.
TEST_P(WallForces, ImpulseIsWeightTimesTimeLessTheChangeOfMomentum) {
    const Scene scene = scene_of(test::small_scene_text, {std::string("run.integrator=") + GetParam()});
    const Plan plan = make_plan(scene);
    SimulatedBed run(scene, plan, 1);
    run.pack();
    const Vec3 before = momentum(scene, run.frame());
    const int rows = 16;  // two periods
    Vec3 impulse(0, 0, 0);
    for (int row = 1; row <= rows; ++row) {
        const std::int64_t from = run.step();
        run.advance(std::llround(row * plan.measures_every));
        const Measures m = run.measures();
        for (const std::string& face : face_names(scene))
            impulse += static_cast<double>(run.step() - from) * plan.clock.step * force_on(m, face);
    }
    const double time = plan.clock.time(run.step()), weight = mass(scene) * scene.gravity.norm();
    ASSERT_NEAR(time, 2 / scene.drive.frequency, 1e-12);
    const Vec3 expected = time * mass(scene) * scene.gravity - (momentum(scene, run.frame()) - before);
    EXPECT_LT((impulse - expected).norm(), 1e-9 * weight * time);
    EXPECT_GT((momentum(scene, run.frame()) - before).norm(), 1e-6 * weight * time) << "nothing moves";
}

INSTANTIATE_TEST_SUITE_P(Integrators, WallForces,
                         testing::Values("velocity-verlet", "leapfrog", "position-verlet", "forest-ruth"),
                         [](const testing::TestParamInfo<const char*>& one) {
                             std::string name = one.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

// A scene with one grain that comes to rest by dashpots.
const std::string kOneGrain =
    test::SmallScene()
        .beads(0, "ball")
        .more("[contact]\nlaw = \"spring-dashpot\"\nstiffness = 2000\nrestitution = 0.1\n")
        .more("friction_law = \"none\"\n")
        .box("30 mm", "20 mm", "16 mm")
        .more("[[grain]]\nposition = [\"3 mm\", \"-5 mm\", \"2 mm\"]\n")
        .lasts("1 s")
        .more("[output]\nmeasures_interval = \"0.1 s\"\n")
        .text();

Measures at_rest(const Scene& scene, std::vector<FieldValues>* fields = nullptr) {
    SimulatedBed run(scene, make_plan(scene), 1);
    run.pack();
    run.advance(make_plan(scene).steps);
    if (fields) *fields = run.fields();
    return run.measures();
}

TEST(WallForcesAtRest, AFloorCarriesAGrain) {
    const Scene scene = scene_of(kOneGrain);
    const Measures m = at_rest(scene);
    const double weight = mass(scene) * 9.81;
    const double accuracy = of_rounding(1e-9, 1e-5) * weight;
    EXPECT_LT((force_on(m, "floor") - Vec3(0, 0, -weight)).norm(), accuracy);
    // r x F about the middle of the floor, r = (3 mm, -5 mm).
    EXPECT_LT((moment_on(m, "floor") - Vec3(0.005 * weight, 0.003 * weight, 0)).norm(), 0.01 * accuracy);
    EXPECT_NEAR(m.at("floor_carries"), 1, of_rounding(1e-9, 1e-5));
    for (const char* wall : {"left_wall", "right_wall", "front", "back", "lid"}) {
        EXPECT_EQ(force_on(m, wall).norm(), 0) << wall;
        EXPECT_EQ(m.at(std::string(wall) + "_carries"), 0) << wall;
    }
}

// Without friction each slant pushes along its normal (0, +-cos t, sin t), and both together carry the
// weight: N = W / (2 sin t).
TEST(WallForcesAtRest, AWedgeCarriesAGrainOnBothSides) {
    std::string text = kOneGrain;
    const auto at = text.find("shape"), end = text.find("[[grain]]");
    text.replace(at, end - at,
                 "shape = \"wedge\"\nhalf_angle = \"30 deg\"\nslant_height = \"20 mm\"\n"
                 "half_width = \"12 mm\"\ndepth = \"20 mm\"\nheight = \"32 mm\"\n");
    // Half the floor is 12 - 20 tan 30 = 0.453 mm. A grain of radius 2 mm touches both slants where
    // (0.453 mm + z tan 30) cos 30 = 2 mm: at z = 3.216 mm, and at z + 2 mm * -sin 30 = 2.216 mm of height.
    text.replace(text.find("[\"3 mm\", \"-5 mm\", \"2 mm\"]"), 25, "[\"1 mm\", 0, \"3.3 mm\"]");
    const Scene scene = scene_of(text);
    std::vector<FieldValues> fields;
    const Measures m = at_rest(scene, &fields);
    const double weight = mass(scene) * 9.81, angle = std::numbers::pi / 6;
    const double push = weight / (2 * std::sin(angle)), accuracy = of_rounding(1e-9, 1e-5) * weight;
    EXPECT_LT((force_on(m, "left_slant") - push * Vec3(0, -std::cos(angle), -std::sin(angle))).norm(),
              accuracy);
    EXPECT_LT((force_on(m, "right_slant") - push * Vec3(0, std::cos(angle), -std::sin(angle))).norm(),
              accuracy);
    EXPECT_NEAR(m.at("left_slant_carries"), 0.5, of_rounding(1e-9, 1e-5));
    // Moments are taken about the middle of the floor. The slants touch the grain 2 mm along their normals.
    for (const auto& [slant, side] : {std::pair{"left_slant", -1}, {"right_slant", 1}}) {
        const Vec3 touched(0.001, side * 0.002 * std::cos(angle), 0.002216);
        EXPECT_LT((moment_on(m, slant) - touched.cross(force_on(m, slant))).norm(), 1e-3 * 0.002 * push)
            << slant;
    }
    EXPECT_EQ(m.at("floor_carries"), 0);
    // There are four slices of 8 mm. The push is in the lowest one, over its part of the slant.
    const SimulatedBed run(scene, make_plan(scene), 1);
    const FieldSet& set = *run.field_sets().at(0);
    ASSERT_EQ(set.axes.at(0).at.size(), 4u);
    for (std::size_t s = 0; s < 4; ++s)
        EXPECT_NEAR(set.axes.at(0).at[s], 0.004 + 0.008 * static_cast<double>(s), 1e-12);
    const auto slant = std::find_if(set.fields.begin(), set.fields.end(), [](const FieldInfo& field) {
        return field.name == "pressure_left_slant";
    });
    ASSERT_NE(slant, set.fields.end());
    const std::vector<double>& pressure =
        fields.at(0).at(static_cast<std::size_t>(slant - set.fields.begin()));
    EXPECT_NEAR(pressure[0], push / (0.02 * 0.008 / std::cos(angle)), of_rounding(1e-9, 1e-5) * pressure[0]);
    EXPECT_EQ(pressure[1], 0);
    EXPECT_TRUE(std::isnan(pressure[3])) << "above the slant";
}

// There are nine records of 0.1 s. In the fifth one the grain is taken away.
TEST(WallForcesOfRuns, PressureIsTheMeanOfItsRecord) {
    const test::TemporaryFolder here;
    std::string text = kOneGrain;
    text.replace(text.find("\"3 mm\", \"-5 mm\""), 15, "\"3 mm\", \"13 mm\"");
    Scene scene = scene_of(text, {"gravity=[0, 9.81, 0]"});
    const Plan plan = make_plan(scene);
    const double weight = mass(scene) * 9.81, slice = 0.016 / 2;
    SimulatedBed run(scene, plan, 1);
    run.pack();
    const auto of_right_wall = [&](const SimulatedBed& of) {
        const FieldSet& set = *of.field_sets().at(0);
        const std::vector<FieldValues> values = of.fields();
        for (std::size_t f = 0; f < set.fields.size(); ++f)
            if (set.fields[f].name == "pressure_right_wall") {
                double sum = 0;
                for (const double pressure : values.at(0).at(f)) sum += pressure;
                return sum;
            }
        return -1.0;
    };
    run.advance(4 * plan.fields.record);
    EXPECT_NEAR(of_right_wall(run), weight / (0.02 * slice), of_rounding(1e-9, 1e-5) * of_right_wall(run));
    run.advance(4 * plan.fields.record + plan.fields.record / 2);
    run.save_checkpoint(here / "half.grs");
    run.remove({0});
    run.advance(5 * plan.fields.record);
    EXPECT_NEAR(of_right_wall(run), 0.5 * weight / (0.02 * slice), 1e-3 * of_right_wall(run));
    run.advance(6 * plan.fields.record);
    EXPECT_EQ(of_right_wall(run), 0);

    SimulatedBed again = SimulatedBed::at_checkpoint(scene, plan, here / "half.grs", 1);
    again.remove({0});
    again.advance(5 * plan.fields.record);
    EXPECT_NEAR(of_right_wall(again), 0.5 * weight / (0.02 * slice), 1e-3 * of_right_wall(again));
    again.save_checkpoint(here / "end.grs");  // before the record is written
    const double written = of_right_wall(again);
    EXPECT_EQ(of_right_wall(SimulatedBed::at_checkpoint(scene, plan, here / "end.grs", 1)), written);

    // Nothing is known of a row whose beginning was not seen.
    Scene without = scene;
    without.output.instruments.clear();
    SimulatedBed blind(without, plan, 1);
    blind.pack();
    blind.advance(2 * plan.fields.record + 7);
    blind.save_checkpoint(here / "blind.grs");
    SimulatedBed late = SimulatedBed::at_checkpoint(scene, plan, here / "blind.grs", 1);
    late.advance(3 * plan.fields.record);
    EXPECT_TRUE(std::isnan(of_right_wall(late)));
    late.advance(4 * plan.fields.record);
    EXPECT_NEAR(of_right_wall(late), weight / (0.02 * slice), of_rounding(1e-9, 1e-5) * of_right_wall(late));
}

std::vector<double> later_row(SimulatedBed& run, const Plan& plan, int row) {
    run.advance(std::llround(row * plan.measures_every));
    return run.measures().values();
}

TEST(WallForcesOfRuns, AreTheSameBitsAtAnyNumberOfThreadsAndWhenTakenUp) {
    const test::TemporaryFolder here;
    const Scene scene = scene_of(test::small_scene_text);
    const Plan plan = make_plan(scene);
    SimulatedBed first(scene, plan, 1);
    first.pack();
    first.advance(std::llround(3.4 * plan.measures_every));  // between two rows
    first.save_checkpoint(here / "a.grs");
    const std::vector<double> expected = later_row(first, plan, 4), last = later_row(first, plan, 9);
    EXPECT_EQ(first.fields().at(0).size(), 4u);  // all that stands
    for (const int threads : {2, 3}) {
        SimulatedBed whole(scene, plan, threads);
        whole.pack();
        later_row(whole, plan, 3);
        EXPECT_EQ(later_row(whole, plan, 4), expected) << threads;
        const Scene next = continued(scene, here / "a.grs");
        SimulatedBed taken_up(next, plan, threads);
        taken_up.pack();
        EXPECT_EQ(later_row(taken_up, plan, 4), expected) << threads;
        EXPECT_EQ(later_row(taken_up, plan, 9), last) << threads;
        EXPECT_EQ(taken_up.fields(), first.fields());
    }
}

// Wall forces change nothing of the run, and are there only if somebody asks for them.
TEST(WallForcesOfRuns, ChangeNothing) {
    const Scene with = scene_of(test::small_scene_text);
    Scene without = with;
    without.output.instruments.clear();
    SimulatedBed a(with, make_plan(with), 2), b(without, make_plan(without), 2);
    a.pack(), b.pack();
    a.advance(700), b.advance(700);
    EXPECT_EQ(a.state_hash(), b.state_hash());
    EXPECT_LT(b.measured().size(), a.measured().size());
    EXPECT_TRUE(b.field_sets().empty());
}

TEST(WallForcesOfScenes, AreAskedForByName) {
    const auto read = [](const std::string& more) {
        return read_scene_text(test::small_scene_text + more, "walls.toml", {}, measurable_in).instruments();
    };
    EXPECT_TRUE(read("").empty());
    EXPECT_EQ(read("[output]\ninstruments = [\"walls\"]\n"), std::vector<std::string>{"walls"});
    EXPECT_THROW(read("[output]\ninstruments = [\"wals\"]\n"), UserError);
}

// Two grains of the same weight lie on the floor, which carries both.
TEST(WallForcesAtRest, AFloorCarriesAllGrains) {
    std::string text = kOneGrain;
    text.replace(text.find("[run]"), 5, "[[grain]]\nposition = [0, \"6 mm\", \"2 mm\"]\n[run]");
    const Measures m = at_rest(scene_of(text));
    EXPECT_NEAR(m.at("floor_carries"), 1, of_rounding(1e-9, 1e-5));
}

// The front of a wedge has slants up to 4 and a floor of half-width 1. Between the heights 1 and 3 it is a
// trapezoid. All slices together are the whole face.
TEST(WallAreas, AreThoseOfTheContainersFaces) {
    Container c;
    c.half_width = 3, c.depth = 5, c.height = 10;
    c.half_angle = std::atan(0.5), c.slant_height = 4;
    EXPECT_NEAR(area_between(c, "front", 1, 3), 2 * (2 * 1.5 + 2 * 2.5) / 2, 1e-12);
    EXPECT_NEAR(area_between(c, "back", 3, 6), (2 * 2.5 + 2 * 3) / 2 + 2 * 2 * 3, 1e-12);
    EXPECT_NEAR(area_between(c, "left wall", 3, 6), 5 * 2, 1e-12);
    EXPECT_NEAR(area_between(c, "right slant", 3, 6), 5 * 1 * std::sqrt(1.25), 1e-12);
    EXPECT_EQ(area_between(c, "floor", 0, 10), 0);
    double front = 0;
    for (int k = 0; k < 20; ++k) front += area_between(c, "front", 0.5 * k, 0.5 * (k + 1));
    EXPECT_NEAR(front, c.volume() / c.depth, 1e-12);
    c.shape = Container::Shape::cylinder;
    EXPECT_NEAR(area_between(c, "wall", 9, 12), 2 * std::numbers::pi * 3, 1e-12);
}

// A face whose point is at the height 5 is pressed half a unit above that point, where a periodic depth of 8
// begins anew. The near image of the place is at x = 1.
TEST(WallTally, TakesPlacesInTheRoomAndTheNearestImage) {
    Face face = floor_face();
    face.point = {0, 0, 5};
    WallScale scale;
    scale.force = std::exp2(-40), scale.length = 1, scale.slices = 8, scale.slice = 1, scale.period = 8;
    WallTally tally;
    tally.begin({face}, scale);
    tally.add(0, Vec3(0, 0, -2), 2, Vec3(-7, 3, 0.5));
    WallSums sums;
    tally.add_to(sums);
    const auto moment = [&](int axis) {
        return static_cast<double>(sums.faces[0].last_moment[static_cast<std::size_t>(axis)]) * scale.force;
    };
    EXPECT_NEAR(moment(0), 3 * -2, 1e-9);
    EXPECT_NEAR(moment(1), -(1 * -2), 1e-9);
    ASSERT_EQ(sums.slices.size(), 8u);
    for (std::size_t s = 0; s < 8; ++s)
        EXPECT_NEAR(static_cast<double>(sums.slices[s]) * scale.force, s == 5 ? 2 : 0, 1e-9) << s;
}

TEST(WallTally, CountsInAnyOrder) {
    const Face face = floor_face();
    const std::vector<Face> faces{face};
    WallScale scale;
    scale.force = std::exp2(-40), scale.length = 1, scale.slices = 2, scale.slice = 1;
    const auto tally = [&](const std::vector<double>& pushes, int threads) {
        std::vector<WallTally> all(static_cast<std::size_t>(threads));
        for (WallTally& one : all) one.begin(faces, scale);
        for (std::size_t k = 0; k < pushes.size(); ++k)
            all[k % all.size()].add(0, Vec3(0, 0, -pushes[k]), pushes[k], Vec3(0.1, 0, 0));
        WallSums sums;
        for (const WallTally& one : all) one.add_to(sums);
        return sums;
    };
    const WallSums one = tally({1e-3, 0.1, 0.7, 1e2 / 3}, 1), other = tally({1e2 / 3, 0.7, 1e-3, 0.1}, 3);
    EXPECT_EQ(one.faces, other.faces);
    EXPECT_EQ(one.slices, other.slices);
    EXPECT_NEAR(static_cast<double>(one.faces[0].last_force[2]) * scale.force, -(0.801 + 1e2 / 3),
                2 * scale.force);
    EXPECT_TRUE(is_sound(one, 1, scale));
    EXPECT_FALSE(is_sound(one, 2, scale));
    WallSums forged = one;
    forged.faces[0].force[1] = static_cast<WideInt>(1) << 121;
    EXPECT_FALSE(is_sound(forged, 1, scale));
    forged = one;
    forged.faces[0].last_force[0] = static_cast<WideInt>(1) << 70;
    EXPECT_FALSE(is_sound(forged, 1, scale));
}

}  // namespace
}  // namespace grainreel
