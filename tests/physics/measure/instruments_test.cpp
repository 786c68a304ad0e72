// Tests of instruments that gather values: on states made by hand, in a run, and through a checkpoint.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/measure/columns.hpp"
#include "engine/measure/flow/drift.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/restart.hpp"
#include "engine/state/traffic.hpp"
#include "tests/physics/measure/bed_by_hand.hpp"
#include "tests/physics/measure/inelastic_block.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using Bed = test::BedByHand;

// Waves at f/2 are compared from row to row, and are known from the eighth period on.
TEST(SurfaceInstrument, TellsWavesThatComeEverySecondPeriod) {
    Bed bed("surface");
    const auto wave = [&](int row) {
        const double sign = row / 8 % 2 ? -1 : 1;
        bed.fill(
            [=](double y) { return 10 + 2 * sign * std::cos(2 * std::numbers::pi * 3 * (y + 20) / 40); });
    };
    wave(0), bed.start();
    for (int row = 1; row <= 56; ++row) {
        wave(row), bed.gather(125 * row);
        EXPECT_EQ(std::isnan(bed.look(125 * row, "surface_half")), row < 56) << row;
    }
    // The higher one of two stacks in a bin counts, so crests are a little wider than troughs.
    EXPECT_GT(bed.look(7000, "surface_half"), 0.98);
    EXPECT_LT(bed.look(7000, "surface_quarter"), 0.01);
    EXPECT_NEAR(bed.look(7000, "surface_wavelength_m"), 40.0 / 3, 1e-12);
    EXPECT_TRUE(std::isnan(bed.look(7001, "surface_half")));  // no row was at that phase
}

// There are 20 bins of 2, ten of them on either side. On two levels the bins are 2 above or below their mean.
// If the middle half is 2 higher than the rest, a straight line through each half rises by sum y h / sum y^2
// = 50 / 330. The container stands 5 to the right.
TEST(SurfaceInstrument, HasTheShapeOfSteps) {
    Bed bed("surface");
    bed.pose.offset = {0, 5, 0};
    const auto fill = [&](const std::function<double(double)>& top) {
        bed.fill(top);
        for (Place& place : bed.grains.place) place.position.y() += 5;
    };
    fill([](double y) { return y < 0 ? 10 : 14; });
    EXPECT_NEAR(bed.look(0, "surface_rms_m"), 2, 1e-12);
    EXPECT_NEAR(bed.look(0, "surface_tilt"), 2 * 200.0 / 2660, 1e-12);
    EXPECT_NEAR(bed.look(0, "mound_slope"), 0, 1e-12);
    fill([](double y) { return std::abs(y) < 10 ? 12 : 10; });
    EXPECT_NEAR(bed.look(0, "mound_height_m"), 2, 1e-12);
    EXPECT_NEAR(bed.look(0, "mound_slope"), 50.0 / 330, 1e-12);
    EXPECT_NEAR(bed.look(0, "surface_tilt"), 0, 1e-12);
    EXPECT_NEAR(bed.look(0, "surface_rms_m"), 1, 1e-12);
}

TEST(IntruderInstrument, NotesWhenItCameUp) {
    Bed bed("intruder");
    const auto place = [&](double top) {
        bed.fill([](double) { return 10; });
        bed.grains.add(9000, 1, {0, 0, top - 1.5}, 1.5, 1);
    };
    place(4), bed.start();
    EXPECT_NEAR(bed.look(0, "intruder_level"), 0.4, 1e-12);
    EXPECT_TRUE(std::isnan(bed.look(0, "rise_time_s")));
    place(9), bed.gather(125);
    EXPECT_TRUE(std::isnan(bed.look(125, "rise_time_s")));
    place(10.5), bed.gather(250);
    place(6), bed.gather(375);
    EXPECT_NEAR(bed.look(375, "rise_time_s"), 0.25, 1e-12);
    EXPECT_NEAR(bed.look(375, "intruder_level"), 0.6, 1e-12);
    place(11), bed.gather(500);
    EXPECT_NEAR(bed.look(500, "rise_time_s"), 0.25, 1e-12);  // it has been that high before
}

// 3 kg of big grains and 1 kg of small ones leave one after the other.
TEST(OutflowInstrument, WeighsWhatHasLeft) {
    Bed bed("outflow");
    const auto keep = [&](double small, double big) {
        bed.grains = {};
        const double volume = std::numbers::pi / 6;
        if (small > 0) bed.grains.add(0, 0, {0, 0, 1}, 0.5, small / volume);
        if (big > 0) bed.grains.add(1, 1, {0, 0, 5}, 0.5, big / volume);
    };
    keep(1, 3), bed.start();
    bed.gather(125);
    EXPECT_NEAR(bed.look(125, "outflow_kg"), 0, 1e-12);
    EXPECT_TRUE(std::isnan(bed.look(125, "big_outflow")));
    keep(0.5, 1.5), bed.gather(250);
    EXPECT_NEAR(bed.look(250, "outflow_kg"), 2, 1e-12);
    EXPECT_NEAR(bed.look(250, "outflow_rate"), 2 / 0.125, 1e-9);
    EXPECT_NEAR(bed.look(250, "big_outflow"), 1.5 / 2, 1e-12);
    EXPECT_NEAR(bed.look(250, "small_outflow"), 0.5 / 2, 1e-12);
    EXPECT_TRUE(std::isnan(bed.look(250, "emptied_s")));
    keep(0.045, 0), bed.gather(375);
    EXPECT_TRUE(std::isnan(bed.look(375, "emptied_s")));  // 1 % is 0.04 kg
    keep(0.035, 0), bed.gather(500);
    bed.gather(625);
    EXPECT_NEAR(bed.look(625, "emptied_s"), 0.5, 1e-12);
    EXPECT_NEAR(bed.look(625, "outflow_rate"), 0, 1e-9);
    bed.traffic.came = 1;  // this grain is of no feed
    EXPECT_TRUE(std::isnan(bed.look(625, "outflow_kg")));
}

// A hundred grains of different sizes come from a feed, and one was there before. The number outside follows
// from the grains inside, to the last grain.
TEST(OutflowInstrument, CountsWhatAFeedHasGiven) {
    Bed bed("outflow");
    bed.scene.feeds.resize(1);
    bed.scene.feeds[0].species = 1;
    bed.scene.species[1].diameter = {SizeSpread::Kind::uniform, 0.5, 1.5, 1, 0};
    bed.scene.species[1].density = 2;
    std::vector<double> mass{1};  // kg, of each grain; the first one is small
    bed.add(0, {0, 0, 1}, 0.5, 6 / std::numbers::pi);
    const auto inside = [&](std::size_t from, std::int64_t given) {
        bed.given = {given};
        bed.traffic.came = given;
        bed.grains = {};
        if (from == 0) bed.grains.add(0, 0, {0, 0, 1}, 0.5, 6 / std::numbers::pi);
        for (std::int64_t k = std::max<std::int64_t>(0, static_cast<std::int64_t>(from) - 1); k < given;
             ++k) {
            const ComingGrain grain = fed_grain(bed.scene, 0, k);
            bed.grains.add(static_cast<std::int32_t>(k + 1), 1, {0, 0, 5}, grain.radius, grain.density);
        }
    };
    bed.start();
    double out = 1;
    inside(0, 40), bed.gather(125);
    EXPECT_EQ(bed.look(125, "outflow_kg"), 0);
    EXPECT_EQ(bed.look(125, "outflow_rate"), 0);
    for (int k = 0; k < 29; ++k)
        out += 2 * 4.0 / 3 * std::numbers::pi * std::pow(fed_grain(bed.scene, 0, k).radius, 3);
    inside(30, 100), bed.gather(250);
    EXPECT_NEAR(bed.look(250, "outflow_kg"), out, 1e-12 * out);
    EXPECT_NEAR(bed.look(250, "outflow_rate"), out / 0.125, 1e-9 * out);
    EXPECT_NEAR(bed.look(250, "small_outflow"), 1 / out, 1e-12);
    EXPECT_NEAR(bed.look(250, "big_outflow"), 1 - 1 / out, 1e-12);
    EXPECT_TRUE(std::isnan(bed.look(250, "emptied_s")));
    inside(101, 100), bed.gather(375);
    EXPECT_NEAR(bed.look(375, "emptied_s"), 0.375, 1e-12);
}

// The floor is at 0.3 now, and the lower grain has fallen below it into the tray.
TEST(OutflowInstrument, GrainsInTheTrayAreOut) {
    Bed bed("outflow");
    bed.scene.container.tray = Tray{5, 20};
    bed.pose.offset = {0, 0, 0.3};
    const double volume = std::numbers::pi / 6;
    bed.add(0, {0, 0, 2}, 0.5, 1 / volume);
    bed.add(1, {0, 0, 5}, 0.5, 3 / volume);
    bed.start();
    bed.grains.place[0].position.z() = 0.2;
    bed.gather(125);
    EXPECT_NEAR(bed.look(125, "outflow_kg"), 1, 1e-12);
    bed.scene.container.tray.reset();
    EXPECT_NEAR(bed.look(125, "outflow_kg"), 0, 1e-12);
}

// In two windows of four periods grains rise by different displacements. Drifts are tested in flow_test.cpp.
TEST(ConvectionInstrument, GivesTheDriftOfItsWindows) {
    Bed bed("convection");
    Drift drift(bed.scene);
    for (int period = 0; period <= 8; ++period) {
        bed.fill([](double) { return 10; });
        for (Place& place : bed.grains.place) {
            const double y = place.position.y(), rise = period * (16 + period) * std::cos(0.2 * y + 0.3);
            place.position += 0.0006 * Vec3(0, 0.3 * rise * (place.position.z() - 5), rise);
        }
        period == 0 ? bed.start() : bed.gather(1000 * period);
        if (period % 4 == 0) drift.note(period, bed.grains, {});
    }
    const auto expect = [&](const std::string& column, double value) {
        EXPECT_TRUE(std::isfinite(value)) << column;
        EXPECT_EQ(bed.look(8000, column), value) << column;
    };
    for (const auto& [name, zone] : {std::pair{"flow_left", Drift::at_left_wall},
                                     {"flow_middle", Drift::in_middle},
                                     {"flow_right", Drift::at_right_wall}}) {
        expect(std::string(name) + "_m", drift.rise(zone).mean);
        expect(std::string(name) + "_error_m", drift.rise(zone).error);
    }
    for (const auto& [name, half] : {std::pair{"roll_left", Side::left}, {"roll_right", Side::right}}) {
        expect(std::string(name) + "_m", drift.roll(half).mean);
        expect(std::string(name) + "_error_m", drift.roll(half).error);
        expect(std::string(name) + "_y_m", drift.centre(half).y);
        expect(std::string(name) + "_z_m", drift.centre(half).z);
    }
}

// The bed has two grains, each with half of the weight. Looks are seven steps apart. Between looks the floor
// carries so many weights in the mean: less than a tenth from step 21 on, and more than half from step 35 on.
TEST(BedInstrument, FliesWhileTheFloorCarriesLittleOfTheWeight) {
    Bed bed("bed");
    for (const double y : {-1.0, 1.0}) bed.add(0, {0, y, 1}, 0.5, 0.5 * 6 / std::numbers::pi);
    bed.walls = WallSums{};
    bed.walls->scale.force = 1e-6;
    bed.walls->faces.resize(2);
    bed.start();
    std::int64_t step = 0;
    for (const double carried : {1.0, 0.7, 0.12, 0.08, 0.4, 0.6, 1.2}) {
        const double newtons = -carried * 10 * 7;  // 1 kg, seven steps
        bed.walls->faces[0].force[2] += static_cast<WideInt>(std::llround(newtons / 1e-6));
        bed.gather(step += 7);
    }
    EXPECT_TRUE(std::isnan(bed.look(step, "takeoff_turns"))) << "shorter than a sixteenth of a period";
    for (int look = 0; look < 12; ++look) {
        const double carried = look < 1 ? 1 : look < 11 ? 0.05 : 0.9;
        bed.walls->faces[0].force[2] -= static_cast<WideInt>(std::llround(carried * 70 / 1e-6));
        bed.gather(step += 7);
    }
    EXPECT_NEAR(bed.look(step, "takeoff_turns"), 0.056, 1e-12);  // step 49 + 7
    EXPECT_NEAR(bed.look(step, "landing_turns"), 0.126, 1e-12);
    EXPECT_NEAR(bed.look(step, "flight_periods"), 0.07, 1e-12);
}

TEST(BedInstrument, ExpansionIsHeightOverThatAtRest) {
    Bed bed("bed");
    bed.fill([](double) { return 10; });
    bed.start();
    for (const double expansion : {1.1, 1.3}) {
        bed.fill([](double) { return 10; });
        bed.pose.offset = {0, 0, 0.2};
        for (Place& place : bed.grains.place) place.position.z() = 0.2 + expansion * place.position.z();
        bed.gather(expansion < 1.2 ? 7 : 14);
        EXPECT_NEAR(bed.look(14, "bed_expansion"), expansion, 1e-12);
    }
}

TEST(BedInstrument, ExpansionOfABedThatCameLaterIsNotKnown) {
    Bed bed("bed");
    bed.start();
    bed.fill([](double) { return 10; });
    bed.gather(7);
    EXPECT_TRUE(std::isnan(bed.look(7, "bed_expansion")));
}

Scene shaken(std::vector<std::string> sets = {}) {
    sets.insert(sets.begin(),
                {"output.instruments=[\"bed\", \"surface\", \"convection\", \"intruder\", \"outflow\"]",
                 "start.settle_limit=0.05 s", "contact.stiffness=700 N/m"});
    return read_scene_text(test::small_scene_text, "fifty.toml", with_tested_precision(sets), measurable_in);
}

// Two grains side by side that hardly bounce fly as a block does. A tenth of the weight is carried until sin
// = 0.9 / Gamma, and forces are means over 1/128 of a turn.
TEST(BedInstrument, FindsTheFlightOfABlock) {
    const Scene scene = shaken({"species.small.count=1", "species.big.count=1", "drive.ramp=0",
                                "contact.law=spring-dashpot", "contact.restitution=0.05"});
    const Plan plan = make_plan(scene);
    SimulatedBed run(scene, plan, 1);
    run.pack();
    EXPECT_NEAR(run.measure("bed_expansion"), 1, 1e-12);
    run.advance(3 * plan.clock.steps_per_period);
    const InelasticBlock block(2);
    const double takeoff = run.measure("takeoff_turns"), landing = run.measure("landing_turns");
    EXPECT_GT(takeoff, std::asin(0.9 / 2) / (2 * std::numbers::pi) - 0.01);
    EXPECT_LT(takeoff, block.leaves + 0.01);
    EXPECT_NEAR(landing, block.lands - std::floor(block.lands), 0.02);
    EXPECT_NEAR(run.measure("flight_periods"), landing - takeoff, 1e-9);
}

// The run is stopped in the middle of a window and of a flight, and resumed: every column has the same bits.
TEST(Instruments, GoOnFromACheckpointBitByBit) {
    const test::TemporaryFolder here;
    const Scene scene = shaken({"run.duration=0.7 s", "run.seed=2"});
    const Plan plan = make_plan(scene);
    const std::int64_t period = plan.clock.steps_per_period;
    SimulatedBed whole(scene, plan, 1);
    whole.pack();
    whole.advance(5 * period + period / 3);
    whole.save_checkpoint(here / "broken.grs");
    whole.advance(9 * period);
    const Scene rest = continued(scene, here / "broken.grs");
    SimulatedBed taken_up(rest, make_plan(rest), 2);
    taken_up.pack();
    taken_up.advance(9 * period);
    const Measures expected = whole.measures(), found = taken_up.measures();
    ASSERT_EQ(found.names(), expected.names());
    for (const std::string& name : found.names()) {
        const double a = expected.at(name), b = found.at(name);
        EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << name << " " << a << " " << b;
    }
    for (const char* name :
         {"flow_left_error_m", "roll_right_m", "roll_left_y_m", "surface_half", "takeoff_turns"})
        EXPECT_TRUE(std::isfinite(expected.at(name))) << name;
}

}  // namespace
}  // namespace grainreel
