// Instruments that gather: on states by hand, in a run, and through a checkpoint.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/measure/columns.hpp"
#include "engine/measure/observers.hpp"
#include "engine/run/simulation.hpp"
#include "engine/scene/text/reader.hpp"
#include "tests/cli/small_scene.hpp"
#include "tests/cli/temporary_folder.hpp"
#include "tests/physics/measure/inelastic_block.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

constexpr auto no_contacts = [](const auto&) {};

// A box with a floor of stacks of grains of diameter 1, and what an instrument sees of it. A row every 125
// steps, a period of 1000.
struct Bed {
    Scene scene;
    Plan plan;
    Grains grains;
    Traffic traffic;
    std::unique_ptr<Observers> observers;

    explicit Bed(const std::string& instrument) {
        scene.container.shape = Container::Shape::box;
        scene.container.half_width = 20;
        scene.container.depth = 4;
        scene.container.height = 30;
        scene.species.resize(2);
        scene.species[0].name = "small";
        scene.species[0].diameter.mean = 1;
        scene.species[0].count = 1;
        scene.species[1].name = "big";
        scene.species[1].diameter.mean = 3;
        scene.output.instruments = {instrument};
        plan.clock = {1e-3, 1000, 0};
        plan.measures_every = 125;
        observers = std::make_unique<Observers>(all_observers(), scene, plan);
    }
    void fill(const std::function<double(double y)>& top) {
        grains = {};
        for (int j = 0; j < 40; ++j)
            for (int i = 0; i < 4; ++i)
                for (double z = top(j - 19.5) - 0.5; z > 0; z -= 1)
                    grains.add(static_cast<std::int32_t>(grains.size()), 0, {i - 1.5, j - 19.5, z}, 0.5, 1);
    }
    Moment moment(std::int64_t step) const {
        return {scene, plan.clock, grains, step, {0, 0, -10}, 0, {}, 0, traffic};
    }
    void start() { observers->start(moment(0), no_contacts); }
    void gather(std::int64_t step) { observers->gather(moment(step), no_contacts); }
    double look(std::int64_t step, const std::string& column) {
        return observers->look(moment(step), no_contacts, column);
    }
};

// Waves at f/2 from row to row: known from the eighth period on.
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
}

// 3 kg of big and 1 kg of small grains, which leave one after the other.
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
    keep(0.035, 0), bed.gather(375);
    bed.gather(500);
    EXPECT_NEAR(bed.look(500, "emptied_s"), 0.375, 1e-12);
    EXPECT_NEAR(bed.look(500, "outflow_rate"), 0, 1e-9);
    bed.traffic.came = 1;
    EXPECT_TRUE(std::isnan(bed.look(500, "outflow_kg")));
}

Scene shaken(std::vector<std::string> sets = {}) {
    sets.insert(sets.begin(),
                {"output.instruments=[\"bed\", \"surface\", \"convection\", \"intruder\", \"outflow\"]",
                 "start.settle_limit=0.05 s", "contact.stiffness=700 N/m"});
    return read_scene_text(test::small_scene_text, "fifty.toml", with_tested_precision(sets), measurable_in);
}

// Two grains side by side that hardly bounce fly as a block does. A tenth of the weight is carried until
// sin = 0.9 / Gamma, and forces are means over a 128th of a turn.
TEST(BedInstrument, FindsTheFlightOfABlock) {
    const Scene scene = shaken({"species.small.count=1", "species.big.count=1", "drive.ramp=0",
                                "contact.law=spring-dashpot", "contact.restitution=0.05"});
    const Plan plan = make_plan(scene);
    Simulation run(scene, plan, 1);
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

// Broken off in the middle of a window and of a flight, and taken up: every column has the same bits.
TEST(Instruments, GoOnFromACheckpointBitByBit) {
    const test::TemporaryFolder here;
    const Scene scene = shaken({"run.duration=0.7 s"});
    const Plan plan = make_plan(scene);
    const std::int64_t period = plan.clock.steps_per_period;
    Simulation whole(scene, plan, 1);
    whole.pack();
    whole.advance(5 * period + period / 3);
    whole.save_checkpoint(here / "broken.grs");
    whole.advance(9 * period);
    const Scene rest = shaken({"run.duration=0.7 s", "start.method=file",
                               "start.file=" + (here / "broken.grs").string(), "start.keep_clock=true"});
    Simulation taken_up(rest, make_plan(rest), 2);
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
