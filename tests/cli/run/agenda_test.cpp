// Tests of the agenda of a run: the steps at which it stops for measures, frames and key moments.
#include "engine/run/driver/agenda.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace grainreel {
namespace {

std::vector<Stop> all_of(Agenda agenda) {
    std::vector<Stop> stops;
    while (const std::optional<Stop> stop = agenda.next()) stops.push_back(*stop);
    return stops;
}

TEST(Agenda, MergesThreeSchedulesIntoOneStopAStep) {
    const std::vector<Stop> stops = all_of(Agenda({0, 3, 6}, 6, 4, 0, 10));
    std::vector<std::int64_t> steps, frames, trajectory, measures;
    for (const Stop& stop : stops) {
        steps.push_back(stop.step);
        if (stop.frame) frames.push_back(stop.step);
        if (stop.trajectory) trajectory.push_back(stop.step);
        if (stop.measures) measures.push_back(stop.step);
    }
    EXPECT_THAT(steps, testing::ElementsAre(0, 3, 4, 6, 8, 10));
    EXPECT_THAT(frames, testing::ElementsAre(0, 3, 6));
    EXPECT_THAT(trajectory, testing::ElementsAre(0, 6));
    EXPECT_THAT(measures, testing::ElementsAre(0, 4, 8, 10));  // the last step as well
}

TEST(Agenda, StopsAtKeyMomentsFromWhereTheRunIs) {
    Agenda agenda({7}, 6, 0, 3, 10);
    agenda.want_keys({0, 2, 5, 6, 10, 12});
    agenda.goes_on();
    std::vector<std::int64_t> steps, keys;
    for (const Stop& stop : all_of(agenda)) {
        steps.push_back(stop.step);
        if (stop.key) keys.push_back(stop.step);
    }
    EXPECT_THAT(steps, testing::ElementsAre(5, 6, 7, 10));
    EXPECT_THAT(keys, testing::ElementsAre(5, 6, 10));
}

TEST(Agenda, AStepThatIsWantedTwiceIsOneStop) {
    const std::vector<Stop> stops = all_of(Agenda({2, 2}, 0, 0, 0, 4));
    ASSERT_EQ(stops.size(), 3u);
    EXPECT_EQ(stops[1].step, 2);
    EXPECT_TRUE(stops[1].frame);
    EXPECT_FALSE(stops[2].frame);
}

TEST(Agenda, ARunThatGoesOnKeepsItsClock) {
    const std::vector<Stop> stops = all_of(Agenda({0, 5, 9}, 4, 0, 5, 9));
    ASSERT_EQ(stops.size(), 3u);
    EXPECT_EQ(stops[0].step, 5);
    EXPECT_TRUE(stops[0].measures);
    EXPECT_FALSE(stops[0].trajectory);
    EXPECT_EQ(stops[1].step, 8);
    EXPECT_TRUE(stops[1].trajectory);
    EXPECT_EQ(stops[2].step, 9);
}

// Each step is the one nearest to a multiple, so errors do not add up.
TEST(Agenda, AnIntervalOfStepsAndAPartDoesNotDrift) {
    Agenda agenda({}, 2.4, 0, 0, 1000);
    std::int64_t count = 0;
    for (auto stop = agenda.next(); stop; stop = agenda.next()) {
        if (!stop->trajectory) continue;
        EXPECT_EQ(stop->step, std::llround(2.4 * static_cast<double>(count)));
        ++count;
    }
    EXPECT_EQ(count, 417);  // 1000 / 2.4 = 416.7, and the first one
}

TEST(Agenda, NothingWantedStillGoesToTheEnd) {
    const std::vector<Stop> stops = all_of(Agenda({}, 0, 0, 0, 1000));
    ASSERT_EQ(stops.size(), 2u);
    EXPECT_EQ(stops[0].step, 0);
    EXPECT_EQ(stops[1].step, 1000);
    EXPECT_TRUE(stops[0].measures && stops[1].measures);
}

// The drive has 100 steps a period, and from period 5 on 40, after a change over 3 periods.
TEST(Agenda, RhythmsByPeriodsFollowTheDriveThatChanges) {
    Clock clock{0.01, 100, 0};
    const double change = length_of_change(3, 100, 40);
    clock.changes.add({0, 0, 100, 100});
    clock.changes.add({500, 5, 100, 40, change});
    clock.changes.add({500 + change, 8, 40, 40});
    const std::vector<Stop> stops = all_of(Agenda({}, Rhythm(0, 1), Rhythm(0, 0.25), 0, 1999, {}, clock));
    std::int64_t periods = 0, quarters = 0;
    for (const Stop& stop : stops) {
        if (stop.trajectory) {
            EXPECT_EQ(stop.step, clock.step_at(static_cast<double>(periods++)));
        }
        if (stop.measures && stop.step < 1999) {
            EXPECT_EQ(stop.step, clock.step_at(0.25 * static_cast<double>(quarters++)));
        }
    }
    EXPECT_EQ(periods, static_cast<std::int64_t>(clock.cycles(1999)) + 1);
    EXPECT_EQ(quarters, static_cast<std::int64_t>(4 * clock.cycles(1999)) + 1);
}

}  // namespace
}  // namespace grainreel
