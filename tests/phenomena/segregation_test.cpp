// The default scene segregates, and by how much: measured once a period at one phase, over three seeds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "engine/run/simulation.hpp"
#include "engine/scene/reader.hpp"

namespace grainreel {
namespace {

struct Sample {
    double mean = 0, deviation = 0;
};

Sample sample(const std::vector<double>& values, std::size_t first, std::size_t count) {
    Sample s;
    for (std::size_t i = first; i < first + count; ++i) s.mean += values[i] / static_cast<double>(count);
    for (std::size_t i = first; i < first + count; ++i) s.deviation += std::pow(values[i] - s.mean, 2);
    s.deviation = std::sqrt(s.deviation / static_cast<double>(count - 1));
    return s;
}

struct Change {
    Sample before, after;
    double change() const { return after.mean - before.mean; }
    double scatter() const { return std::hypot(before.deviation, after.deviation); }
};

// The first ten periods after the ramp against the last ten.
Change change_of(const std::vector<double>& values) {
    return {sample(values, 3, 10), sample(values, values.size() - 10, 10)};
}

TEST(SegregationLong, ChangesByMoreThanThreeDeviationsInEverySeed) {
    std::vector<double> signs_height, signs_above;
    for (int seed = 1; seed <= 3; ++seed) {
        const Scene scene = read_scene(fmt::format("{}/scenes/wedge_segregation.toml", GRAINREEL_SOURCE),
                                       {fmt::format("run.seed={}", seed)});
        const Plan plan = make_plan(scene);
        Simulation simulation(scene, plan, 0);
        simulation.pack();
        std::vector<double> height, above;
        for (std::int64_t at = 0; at <= plan.steps; at += plan.clock.steps_per_period) {
            simulation.advance(at);
            const Measures m = simulation.measures();
            height.push_back(m.height_difference);
            above.push_back(m.big_above_small);
        }
        const Change h = change_of(height), a = change_of(above);
        fmt::print(
            "seed {}: height difference {:+.3f} -> {:+.3f} (scatter {:.3f}), big above small {:.3f} -> {:.3f} "
            "({:.3f})\n",
            seed, h.before.mean, h.after.mean, h.scatter(), a.before.mean, a.after.mean, a.scatter());
        EXPECT_GT(std::abs(h.change()), 3 * h.scatter()) << "seed " << seed;
        EXPECT_GT(std::abs(a.change()), 3 * a.scatter()) << "seed " << seed;
        signs_height.push_back(std::copysign(1, h.change()));
        signs_above.push_back(std::copysign(1, a.change()));
    }
    EXPECT_EQ(std::abs(std::accumulate(signs_height.begin(), signs_height.end(), 0.0)), 3);
    EXPECT_EQ(std::abs(std::accumulate(signs_above.begin(), signs_above.end(), 0.0)), 3);
}

}  // namespace
}  // namespace grainreel
