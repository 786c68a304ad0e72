// Tests of figures of columns and of outflow, against series whose true mean, slope and law are known.
#include "engine/questions/column_figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/base/error.hpp"
#include "engine/measure/flow/beverloo.hpp"
#include "engine/questions/discharge.hpp"
#include "engine/questions/field_means.hpp"
#include "engine/questions/steadiness.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;

TEST(TimeWindows, AreTwoTimesOrOne) {
    EXPECT_EQ(time_window("0.2s..0.8 s").from, 0.2);
    EXPECT_EQ(time_window("200ms..0.8").to, 0.8);
    EXPECT_TRUE(std::isinf(time_window("0.2s..").to));
    EXPECT_TRUE(std::isinf(time_window("..1s").from));
    for (const char* wrong : {"0.2s", "0.8s..0.2s", "a..b", "0.2 kg..1 s"})
        EXPECT_THROW(time_window(wrong), UserError) << wrong;
}

struct Rows {
    std::vector<double> times, values;
};

// Steps of mean `slope` and of deviation 1 that are independent of each other, summed up.
Rows walk(std::mt19937& random, std::size_t count, double slope) {
    std::normal_distribution<double> step(slope, 1);
    Rows rows;
    double value = 0;
    for (std::size_t i = 0; i < count; ++i) {
        rows.times.push_back(static_cast<double>(i));
        rows.values.push_back(value += step(random));
    }
    return rows;
}

// The interval of a slope holds the true one in about 95 % of 500 walks.
TEST(SlopeEstimates, HoldTheTrueSlopeOfAWalk) {
    std::mt19937 random(7);
    int held = 0, given = 0;
    for (int k = 0; k < 500; ++k) {
        const Rows rows = walk(random, 200, 3);
        const Estimate slope = slope_estimate(rows.times, rows.values);
        if (std::isnan(slope.half_width)) continue;
        ++given;
        held += std::abs(slope.value - 3) <= slope.half_width ? 1 : 0;
    }
    EXPECT_GT(given, 450);
    EXPECT_GT(held, 0.91 * given);
    EXPECT_LT(held, 0.995 * given);
}

TEST(SlopeEstimates, OfALineIsItsSlope) {
    Rows line;
    for (int i = 0; i < 30; ++i) line.times.push_back(0.1 * i), line.values.push_back(4 - 2 * 0.1 * i);
    const Estimate slope = slope_estimate(line.times, line.values);
    EXPECT_NEAR(slope.value, -2, 1e-12);
    EXPECT_NEAR(slope.half_width, 0, 1e-9);
}

TEST(SlopeEstimates, OfFewRowsHaveNoInterval) {
    std::mt19937 random(7);
    const Rows rows = walk(random, 20, 1);
    const Estimate slope = slope_estimate(rows.times, rows.values);
    EXPECT_TRUE(std::isfinite(slope.value));
    EXPECT_TRUE(std::isnan(slope.half_width));
    EXPECT_THAT(slope.why, tells({"too short", "20 rows"}));
}

// A parabola is no line: the slopes of its parts hang together.
TEST(SlopeEstimates, OfACurveHaveNoInterval) {
    std::mt19937 random(7);
    Rows rows = walk(random, 400, 0);
    for (std::size_t i = 0; i < rows.times.size(); ++i) rows.values[i] = 20 * std::sin(rows.times[i] / 60);
    EXPECT_TRUE(std::isnan(slope_estimate(rows.times, rows.values).half_width));
}

TEST(MeanEstimates, HoldTheTrueMeanOfNoise) {
    std::mt19937 random(11);
    std::normal_distribution<double> noise(5, 1);
    int held = 0, given = 0;
    for (int k = 0; k < 300; ++k) {
        Rows rows;
        for (int i = 0; i < 200; ++i) rows.times.push_back(i), rows.values.push_back(noise(random));
        const Estimate mean = mean_estimate(rows.times, rows.values, 0);
        if (std::isnan(mean.half_width)) continue;
        ++given;
        held += std::abs(mean.value - 5) <= mean.half_width ? 1 : 0;
    }
    EXPECT_GT(given, 240);
    EXPECT_GT(held, 0.91 * given);
}

TEST(MeanEstimates, OfAWalkHaveNoInterval) {
    std::mt19937 random(11);
    const Rows rows = walk(random, 300, 0);
    const Estimate mean = mean_estimate(rows.times, rows.values, 0);
    EXPECT_TRUE(std::isnan(mean.half_width));
    EXPECT_THAT(mean.why, tells({"too short"}));
}

Scene box_with_slot(const std::string& periodic) {
    return read_scene_text(
        "[[species]]\nname = \"sand\"\ncount = 500\ndiameter = \"2 mm\"\ndensity = \"2500 kg/m3\"\n"
        "[contact]\nfriction = 0.5\n[container]\nshape = \"box\"\nwidth = \"60 mm\"\ndepth = \"20 mm\"\n"
        "height = \"100 mm\"\n" +
            periodic + "[container.outlet]\nwidth = \"16 mm\"\n[run]\nduration = \"1 s\"\n",
        "slot.toml");
}

// W = 1.03 rho sqrt(g) L (B - k d)^(3/2) with rho = 0.6 x 2500 kg/m3, k = 1.4, d = 2 mm.
TEST(BeverloosLaw, IsThatOfTheSlot) {
    const double rho = 0.6 * 2500, g = 9.81, free = 0.016 - 1.4 * 0.002;
    const double for_a_length = 1.03 * rho * std::sqrt(g) * std::pow(free, 1.5);
    const Scene with_ends = box_with_slot("");
    ASSERT_TRUE(beverloo_rate(with_ends));
    EXPECT_NEAR(*beverloo_rate(with_ends) / (for_a_length * (0.02 - 1.4 * 0.002)), 1, 1e-3);
    EXPECT_NEAR(*beverloo_rate(box_with_slot("periodic_depth = true\n")) / (for_a_length * 0.02), 1, 1e-3);
}

TEST(BeverloosLaw, IsThatOfTheHole) {
    const Scene scene = read_scene_text(
        "[[species]]\nname = \"sand\"\ncount = 500\ndiameter = \"2 mm\"\ndensity = \"2500 "
        "kg/m3\"\n[contact]\nfriction "
        "= 0.5\n[container]\nshape = \"cylinder\"\ndiameter = \"60 mm\"\nheight = \"100 "
        "mm\"\n[container.outlet]\n"
        "diameter = \"14 mm\"\n[run]\nduration = \"1 s\"\n",
        "hole.toml");
    ASSERT_TRUE(beverloo_rate(scene));
    EXPECT_NEAR(*beverloo_rate(scene) / (0.58 * 1500 * std::sqrt(9.81) * std::pow(0.014 - 0.0028, 2.5)), 1,
                1e-3);
    EXPECT_THAT(beverloo_words(scene), tells({"0.58", "5/2", "14 mm"}));
}

TEST(BeverloosLaw, IsSilentWithoutAnOutlet) {
    EXPECT_FALSE(beverloo_rate(read_scene_text(small_scene_text, "fifty.toml")));
}

// 2 kg run out at 0.5 kg/s from 1 s on, in 400 grains: empty at 1 + 0.99 x 4 s.
TEST(Discharges, TellRateAndEmptying) {
    std::vector<double> times, gone;
    for (int k = 1; k <= 400; ++k) times.push_back(1 + 0.01 * k), gone.push_back(0.005 * k);
    const auto flow = discharge_of(times, gone, 2);
    ASSERT_TRUE(flow);
    EXPECT_NEAR(flow->rate.value, 0.5, 0.01 * 0.5);
    ASSERT_TRUE(flow->emptied);
    EXPECT_NEAR(*flow->emptied, 1 + 0.99 * 4, 0.011);
    const auto half = discharge_of(times, gone, 4);
    ASSERT_TRUE(half->would_empty);
    EXPECT_FALSE(half->emptied);
    EXPECT_NEAR(*half->would_empty, 1 + 8, 0.01 * 8);
    EXPECT_FALSE(discharge_of({times.begin(), times.begin() + 20}, {gone.begin(), gone.begin() + 20}, 2));
    EXPECT_FALSE(discharge_of(times, gone, 0)->would_empty) << "more comes in";
}

// A bed of 4 x 4 x 3 cells of 1 cm with the density 1500 kg/m3 and a velocity that depends on the place.
template <class Flow>
MeanFields fields_with(const Flow& flow) {
    MeanFields fields;
    for (std::vector<double>& axis : fields.middles)
        for (int k = 0; k < (&axis == &fields.middles[2] ? 3 : 4); ++k) axis.push_back(0.01 * k - 0.015);
    fields.names = {"density", "velocity_x", "velocity_y", "velocity_z"};
    fields.values.resize(4);
    for (const double z : fields.middles[2])
        for (const double y : fields.middles[1])
            for (const double x : fields.middles[0]) {
                const Vec3 v = flow(Vec3(x, y, z));
                fields.volume.push_back(1e-6);
                fields.values[0].push_back(1500);
                for (int k = 0; k < 3; ++k) fields.values[static_cast<std::size_t>(k) + 1].push_back(v[k]);
            }
    return fields;
}

// v = 2 r along the radius: in the ring of the four middle cells r is 5 mm times sqrt 2.
TEST(RingMeans, TurnVelocitiesToTheAxis) {
    const RingFields away =
        rings_of(fields_with([](const Vec3& p) { return Vec3(2 * p.x(), 2 * p.y(), 0.3); }));
    ASSERT_EQ(away.names.back(), "velocity_r");
    EXPECT_NEAR(away.values.back()[0], 2 * 0.005 * std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(away.r[0], 0.005, 1e-12);
    const auto up = std::find(away.names.begin(), away.names.end(), "velocity_z") - away.names.begin();
    EXPECT_NEAR(away.values[static_cast<std::size_t>(up)][0], 0.3, 1e-12);
    const RingFields turning = rings_of(fields_with([](const Vec3& p) { return Vec3(-p.y(), p.x(), 0); }));
    for (const double value : turning.values.back()) EXPECT_NEAR(value, 0, 1e-15);
}

// Half of the bed rises at 2 cm/s, half sinks: the mass of the bed of 3 cm passes in 2 x 3 / 2 s.
TEST(RingMeans, TurnoverIsTheMassOverWhatRises) {
    const MeanFields roll = fields_with([](const Vec3& p) { return Vec3(0, 0, p.y() > 0 ? 0.02 : -0.02); });
    EXPECT_NEAR(turnover_time(roll), 3, 1e-9);
    EXPECT_TRUE(std::isnan(turnover_time(fields_with([](const Vec3&) { return Vec3(0, 0, -1); }))));
}

TEST(RingMeans, NeedThreeDimensions) {
    MeanFields flat = fields_with([](const Vec3&) { return Vec3(0, 0, 0); });
    flat.middles[0].clear();
    EXPECT_THROW(rings_of(flat), UserError);
}

}  // namespace
}  // namespace grainreel
