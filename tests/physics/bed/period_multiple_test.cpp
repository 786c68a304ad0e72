// Tests of the number of periods after which a bed repeats itself, on made series and on a ball on a shaken
// plate.
#include "engine/measure/bed/bed_formulas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/base/random.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"

namespace grainreel {
namespace {

constexpr double kDiameter = 1;
constexpr int kPhases = PeriodMultiple::kPhases;

// height(t) takes t in periods.
template <class Height>
int multiple_of(int periods, const Height& height, std::int64_t first = 0) {
    PeriodMultiple multiple(kDiameter);
    for (std::int64_t n = first; n < first + periods * kPhases; ++n)
        multiple.add(n, height(static_cast<double>(n) / kPhases));
    return multiple.value();
}

double wave(double t, double period) {
    return std::sin(2 * std::numbers::pi * t / period);
}

TEST(PeriodMultiple, IsThePeriodOfASeries) {
    EXPECT_EQ(multiple_of(40, [](double t) { return wave(t, 1); }), 1);
    EXPECT_EQ(multiple_of(40, [](double) { return 3.0; }), 1);
    for (const int periods : {2, 3, 4})
        for (const int first : {0, 3, 1001})
            EXPECT_EQ(multiple_of(
                          40, [&](double t) { return wave(t, 1) + 0.3 * wave(t, periods); }, first),
                      periods);
    EXPECT_EQ(multiple_of(40, [](double t) { return wave(t, 1) + wave(t, 5); }), 1) << "too long to be seen";
}

// A wave of amplitude A and two periods differs from the period before by a wave of amplitude 2 A, and by
// nothing from two periods before. The root mean square over whole waves is sqrt(2) A.
TEST(PeriodMultiple, DifferenceIsTheRootMeanSquare) {
    PeriodMultiple multiple(kDiameter);
    for (std::int64_t n = 0; n < 12 * kPhases; ++n)
        multiple.add(n, 0.3 * wave(static_cast<double>(n) / kPhases, 2));
    EXPECT_NEAR(multiple.difference(), std::numbers::sqrt2 * 0.3, 1e-12);
}

// The limit is a tenth of a grain. A sine of period 2 changes by twice its amplitude, whose root mean square
// is sqrt(2) times the amplitude.
TEST(PeriodMultiple, DoesNotSeeWhatIsSmallAgainstAGrain) {
    const auto series = [](double amplitude) {
        return [amplitude](double t) { return wave(t, 1) + amplitude * wave(t, 2); };
    };
    EXPECT_EQ(multiple_of(40, series(0.9 * 0.1 / std::numbers::sqrt2)), 1);
    EXPECT_EQ(multiple_of(40, series(1.1 * 0.1 / std::numbers::sqrt2)), 2);
}

TEST(PeriodMultiple, IsOneForDriftAndNoise) {
    Random random(3, Stream::centres);
    EXPECT_EQ(multiple_of(60, [](double t) { return wave(t, 1) + 0.5 * t; }), 1);
    EXPECT_EQ(multiple_of(200, [&](double t) { return wave(t, 1) + random.uniform(); }), 1);
    EXPECT_EQ(multiple_of(
                  200, [&](double t) { return wave(t, 1) + wave(t, 2) + 0.3 * random.uniform() + 0.01 * t; }),
              2);
}

TEST(PeriodMultiple, IsKnownAfterAsManyPeriodsAsItSays) {
    constexpr int wanted = PeriodMultiple::kWindow + PeriodMultiple::kMost + PeriodMultiple::kConfirm - 1;
    const auto doubled = [](double t) { return wave(t, 2); };
    EXPECT_EQ(multiple_of(wanted - 1, doubled), 1);
    EXPECT_EQ(multiple_of(wanted, doubled), 2);
    // After a change it takes as many, and those that another multiple has to hold longer.
    const auto stops = [](double t) { return wave(t, t < 40 ? 2 : 1); };
    EXPECT_EQ(multiple_of(40, stops), 2);
    constexpr int more = PeriodMultiple::kChange - PeriodMultiple::kConfirm;
    EXPECT_EQ(multiple_of(40 + more, stops), 2);
    EXPECT_EQ(multiple_of(40 + wanted + more, stops), 1);
}

// A bed of two periods stays one of two if every second pair differs a little, or if a few periods slip.
TEST(PeriodMultiple, StaysThroughASlipAndASmallModulation) {
    EXPECT_EQ(multiple_of(60, [](double t) { return wave(t, 2) + 0.2 * wave(t, 4); }), 2);
    EXPECT_EQ(multiple_of(60, [](double t) { return wave(t, 2) + wave(t, 4); }), 4);
    PeriodMultiple multiple(kDiameter);
    for (std::int64_t n = 0; n < 60 * kPhases; ++n) {
        const double t = static_cast<double>(n) / kPhases;
        multiple.add(n, wave(t, 2) + (t > 30 && t < 35 ? wave(t, 4) : 0));
        if (t > 12) {
            ASSERT_EQ(multiple.value(), 2) << t;
        }
    }
}

TEST(PeriodMultiple, BeginsAnewAfterAGap) {
    PeriodMultiple multiple(kDiameter);
    for (std::int64_t n = 0; n < 8 * kPhases; ++n) multiple.add(n, wave(static_cast<double>(n) / kPhases, 2));
    for (std::int64_t n = 40 * kPhases + 3; n < 49 * kPhases; ++n)
        multiple.add(n, wave(static_cast<double>(n) / kPhases, 2));
    EXPECT_EQ(multiple.value(), 1) << "eight periods and eight are not sixteen";
}

// A ball on a sine plate lands once a period from g_level = pi (1 - e) / (1 + e) on, and its period doubles
// at g_level^2 = [pi (1 - e) / (1 + e)]^2 + [2 (1 + e^2) / (1 + e)^2]^2 (docs/reference/validation.md): 3.07
// for e = 0.1.
TEST(PeriodMultiple, OfABallOnAPlateIsTwoAboveTheFirstDoubling) {
    constexpr double e = 0.1;
    const double doubling =
        std::hypot(std::numbers::pi * (1 - e) / (1 + e), 2 * (1 + e * e) / std::pow(1 + e, 2));
    for (const auto& [g_level, expected] : {std::pair{0.9 * doubling, 1}, {1.04 * doubling, 2}}) {
        const Scene scene =
            read_scene_text(test::SmallScene()
                                .beads(0, "ball")
                                .contacts("0.1", "0")
                                .box("20 mm", "20 mm", "90 mm")
                                .more("[drive]\nfrequency = \"25 Hz\"\n[[grain]]\nspecies = \"ball\"\n")
                                .more("position = [\"0 mm\", \"0 mm\", \"2 mm\"]\n")
                                .lasts("2.4 s")
                                .text(),
                            "ball.toml", {"drive.g_level=" + std::to_string(g_level)});
        const Plan plan = make_plan(scene);
        SimulatedBed simulation(scene, plan, 1);
        simulation.pack();
        simulation.advance(plan.steps);
        EXPECT_EQ(simulation.measure("bed_periods"), expected) << g_level;
    }
}

}  // namespace
}  // namespace grainreel
