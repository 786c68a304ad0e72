#include "render/run/moments/period_means.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace grainreel {
namespace {

constexpr Clock kClock{1e-4, 800, 0};  // 12.5 Hz

Film mean_film(int periods) {
    Film film;
    film.segments.resize(1);
    film.segments[0].average = periods;
    return film;
}

Frame frame_at(std::int64_t step, const Vec3& position, const Vec3& wall = Vec3::Zero()) {
    Frame frame;
    frame.step = step;
    frame.time = kClock.time(step);
    frame.id = {0};
    frame.position = {position};
    frame.velocity = {Vec3(9, 9, 9)};
    frame.container().place = frame.floor().place = wall;
    return frame;
}

// A grain that shakes with the container and drifts: x = sin(2 pi f t), in all three directions, plus v t.
Vec3 shaken(std::int64_t step, const Vec3& drift) {
    const double turn = 2 * std::numbers::pi * kClock.cycles(step);
    return Vec3(0.001, 0.004, 0.005) * std::sin(turn) + drift * kClock.time(step);
}

TEST(PeriodMeans, LeaveTheDriftAlone) {
    const Vec3 drift(0, 0.02, -0.01);
    constexpr std::int64_t kShot = 4300;
    PeriodMeans means({{kShot, 0}}, mean_film(3).segments, kClock, {1}, 0, 0);
    EXPECT_THAT(means.steps(), testing::SizeIs(3 * 16 + 1));
    for (const std::int64_t step : means.steps())
        means.keep(frame_at(step, shaken(step, drift), shaken(step, Vec3::Zero())));
    Frame now = frame_at(kShot, shaken(kShot, drift), shaken(kShot, Vec3::Zero()));
    means.fill(now, 1);
    // The mean of 48 samples, 1/16 of a period apart and ending now, lags by half of 47 of them.
    const Vec3 expected = drift * (kClock.time(kShot) - 0.5 * 47 * 50 * kClock.step);
    EXPECT_LT((now.position[0] - expected).norm(), 1e-15);
    EXPECT_LT((now.velocity[0] - drift).norm(), 1e-13);
    EXPECT_LT(now.container().place.norm(), 1e-15);
    EXPECT_LT(now.container().velocity.norm(), 1e-13);
}

// A bed that repeats itself every second period: means of one period become means of two.
TEST(PeriodMeans, SpanThePeriodsOfTheBed) {
    const Vec3 drift(0, 0.02, -0.01);
    constexpr std::int64_t kShot = 4300;
    const auto doubled = [&](std::int64_t step) -> Vec3 {
        return shaken(step, drift) + Vec3(0, 0, 0.003) * std::sin(std::numbers::pi * kClock.cycles(step));
    };
    for (const int periods : {1, 2}) {
        PeriodMeans means({{kShot, 0}}, mean_film(1).segments, kClock, {1, 2}, 0, 0);
        for (const std::int64_t step : means.steps())
            if (step != kShot) means.keep(frame_at(step, doubled(step)));
        Frame frame = frame_at(kShot, doubled(kShot));
        means.keep(frame);
        means.fill(frame, periods);
        const double error = (frame.velocity[0] - drift).norm();
        if (periods == 2)
            EXPECT_LT(error, 1e-12);
        else
            EXPECT_GT(error, 0.01);
        // The mean over 16 moments, the last of them the shot's own, spread over those periods.
        Vec3 mean = Vec3::Zero();
        for (int k = 0; k < 16; ++k) mean += doubled(kShot - k * periods * kClock.steps_per_period / 16) / 16;
        EXPECT_LT((frame.position[0] - mean).norm(), 1e-12);
    }
}

TEST(PeriodMeans, GoTheShortWayRoundAPeriodicContainer) {
    constexpr double kDepth = 0.04;
    const Vec3 drift(0.1, 0, 0);
    const auto wrapped = [&](std::int64_t step) {
        Vec3 at = drift * kClock.time(step) + Vec3(0.019, 0, 0);
        at.x() -= kDepth * std::round(at.x() / kDepth);
        return at;
    };
    PeriodMeans means({{1600, 0}}, mean_film(1).segments, kClock, {1}, 0, kDepth);
    for (const std::int64_t step : means.steps()) means.keep(frame_at(step, wrapped(step)));
    Frame now = frame_at(1600, wrapped(1600));
    means.fill(now, 1);
    double expected = 0.1 * (kClock.time(1600) - 0.5 * 15 * 50 * kClock.step) + 0.019;
    expected -= kDepth * std::round(expected / kDepth);
    EXPECT_NEAR(now.position[0].x(), expected, 1e-15);
    EXPECT_NEAR(now.velocity[0].x(), 0.1, 1e-12);
}

TEST(PeriodMeans, TakeTheBedToHaveRestedBeforeTheRun) {
    PeriodMeans means({{400, 0}}, mean_film(1).segments, kClock, {1}, 0, 0);
    EXPECT_EQ(*means.steps().begin(), 0);
    for (const std::int64_t step : means.steps())
        means.keep(frame_at(step, Vec3(0, 0, 1e-5 * static_cast<double>(step))));
    Frame now = frame_at(400, Vec3(0, 0, 4e-3));
    means.fill(now, 1);
    double expected = 0;  // 9 samples from step 0 to 400, and 7 of rest
    for (int k = 0; k <= 8; ++k) expected += 1e-5 * 50 * k / 16;
    EXPECT_NEAR(now.position[0].z(), expected, 1e-15);
}

TEST(PeriodMeans, LeaveOtherPicturesAsTheyAre) {
    Film film = mean_film(1);
    film.segments.emplace_back();
    PeriodMeans means({{800, 0}, {1000, 1}}, film.segments, kClock, {1}, 0, 0);
    Frame now = frame_at(1000, Vec3(1, 2, 3));
    means.fill(now, 1);
    EXPECT_EQ(now.position[0], Vec3(1, 2, 3));
    EXPECT_EQ(now.velocity[0], Vec3(9, 9, 9));
}

}  // namespace
}  // namespace grainreel
