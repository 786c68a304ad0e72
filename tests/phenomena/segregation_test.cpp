// Two wedges of scenes/, measured once a period at phase 0 over three seeds: in the default film's the big
// grains gather on top, in wedge_mixing.toml they stay mixed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/measure/columns.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {
namespace {

// Mean height of the big grains less that of the small ones, over the bed's height.
struct HeightDifference {
    double after_ramp = 0, at_end = 0;  // means of ten periods: the first after the ramp, and the last
};

double mean_of_ten(const std::vector<double>& values, std::size_t first) {
    double sum = 0;
    for (std::size_t i = first; i < first + 10; ++i) sum += values.at(i);
    return sum / 10;
}

HeightDifference height_difference(const std::string& scene_file, int seed) {
    const Scene scene = read_scene(fmt::format("{}/scenes/{}", GRAINREEL_SOURCE, scene_file),
                                   {fmt::format("run.seed={}", seed)}, measurable_in);
    const Plan plan = make_plan(scene);
    SimulatedBed simulation(scene, plan, 0);
    simulation.pack();
    std::vector<double> values;
    for (std::int64_t at = 0; at <= plan.steps; at += plan.clock.steps_per_period) {
        simulation.advance(at);
        values.push_back(simulation.measure("height_difference"));
    }
    const HeightDifference h{mean_of_ten(values, 3), mean_of_ten(values, values.size() - 10)};
    fmt::print("{}, seed {}: height difference {:+.3f} -> {:+.3f}\n", scene_file, seed, h.after_ramp,
               h.at_end);
    return h;
}

TEST(SegregationLong, TheDefaultFilmsBigGrainsGatherOnTop) {
    for (int seed = 1; seed <= 3; ++seed) {
        const HeightDifference h = height_difference("wedge_segregation.toml", seed);
        EXPECT_LT(h.after_ramp, -0.35) << "seed " << seed;
        EXPECT_GT(h.at_end, 0.2) << "seed " << seed;
    }
}

TEST(SegregationLong, TheMixingWedgeKeepsItsBigGrainsMixed) {
    for (int seed = 1; seed <= 3; ++seed) {
        const HeightDifference h = height_difference("wedge_mixing.toml", seed);
        EXPECT_LT(h.after_ramp, -0.35) << "seed " << seed;
        EXPECT_LT(std::abs(h.at_end), 0.2) << "seed " << seed;
    }
}

}  // namespace
}  // namespace grainreel
