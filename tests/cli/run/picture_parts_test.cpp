// Tests of what pictures show beside their own moment: displacements, exposures and means. They come from a
// run that goes on and keeps the moments that it will need, or from a record with every moment.
#include "render/film/sources/picture_parts.hpp"
#include "render/picture/base/shot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "engine/run/driver/agenda.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

const Clock kClock{1e-4, 800, 0};  // 12.5 Hz

using PlaceAt = std::function<Vec3(std::int64_t step)>;

// A frame of one grain, and a container at the place `wall`.
State frame_at(std::int64_t step, const Vec3& position, const Vec3& wall = Vec3::Zero()) {
    State frame;
    frame.step = step;
    frame.time = kClock.time(step);
    frame.id = {0};
    frame.position = {position};
    frame.velocity = {Vec3(9, 9, 9)};
    frame.container().place = frame.floor().place = wall;
    return frame;
}

Vec3 at_rest(std::int64_t) {
    return Vec3::Zero();
}

// A source that has every moment from `first` on, as a record has.
OtherMoments any_moment(PlaceAt grain, PlaceAt wall, std::int64_t first) {
    return [=](std::int64_t step) -> StatePtr {
        if (step < first) return nullptr;
        return std::make_shared<const State>(frame_at(step, grain(step), wall(step)));
    };
}

FilmedScene scene_with_displacements(double periodic_depth = 0) {
    FilmedScene scene;
    scene.film.shows.colour.by = GrainValue::displacement;
    scene.container.periodic_depth = periodic_depth > 0;
    scene.container.depth = periodic_depth;
    return scene;
}

FilmSegment mean_of(int periods) {
    FilmSegment rule;
    rule.average = periods;
    return rule;
}

struct Asked {
    std::int64_t shot;
    FilmSegment rule;
    int periods = 1;
};

// The picture, made in both ways, which must give the same.
Shot picture(const PictureParts& parts, const Asked& asked, const PlaceAt& grain,
             const PlaceAt& wall = at_rest, std::int64_t first = 0) {
    Shot at_will = frame_at(asked.shot, grain(asked.shot), wall(asked.shot)), passing = at_will;
    parts.add(at_will, asked.rule, asked.periods, {}, any_moment(grain, wall, first));
    KeptStates kept;
    for (const int periods : {1, 2}) kept.want(asked.shot, parts.moments(asked.shot, asked.rule, periods));
    for (std::int64_t step = first; step <= asked.shot; ++step)
        kept.keep(frame_at(step, grain(step), wall(step)));
    parts.add(passing, asked.rule, asked.periods, {}, [&](std::int64_t step) { return kept.at(step); });
    EXPECT_EQ(passing.position, at_will.position);
    EXPECT_EQ(passing.velocity, at_will.velocity);
    EXPECT_EQ(passing.displacement, at_will.displacement);
    EXPECT_EQ(passing.bodies, at_will.bodies);
    EXPECT_EQ(passing.exposed.size(), at_will.exposed.size());
    return at_will;
}

std::vector<std::int64_t> steps_of(const std::vector<WantedState>& moments) {
    std::vector<std::int64_t> steps;
    for (const WantedState& moment : moments) steps.push_back(moment.step);
    return steps;
}

TEST(PictureParts, OfAPlainFilmAreNone) {
    const PictureParts parts(FilmedScene(), kClock, 0);
    EXPECT_TRUE(parts.moments(1600, FilmSegment(), 1).empty());
    const Shot now = picture(parts, {1600, FilmSegment()}, [](std::int64_t) { return Vec3(1, 2, 3); });
    EXPECT_EQ(now.position[0], Vec3(1, 2, 3));
    EXPECT_EQ(now.velocity[0], Vec3(9, 9, 9));
    EXPECT_TRUE(now.displacement.empty() && now.exposed.empty() && now.touches.empty() && !now.measures);
}

TEST(PictureParts, GiveTheWayOfAPeriod) {
    const PictureParts parts(scene_with_displacements(0.04), kClock, 2);
    EXPECT_THAT(steps_of(parts.moments(802, FilmSegment(), 1)), testing::ElementsAre(2));
    EXPECT_TRUE(parts.moments(801, FilmSegment(), 1).empty()) << "before the run there is nothing";
    const auto moved = [](std::int64_t step) {
        // The way goes through the periodic wall: 3 mm, not -37 mm.
        return step < 400 ? Vec3(0.019, 0, 0.1) : Vec3(-0.018, 0.002, 0.11);
    };
    const Shot now = picture(parts, {802, FilmSegment()}, moved, at_rest, 2);
    ASSERT_EQ(now.displacement.size(), 1u);
    EXPECT_LT((now.displacement[0] - Vec3(0.003, 0.002, 0.01)).norm(), 1e-12);
    EXPECT_TRUE(picture(parts, {801, FilmSegment()}, moved, at_rest, 2).displacement.empty());
}

// The bed repeats itself every second period, and its motion in between is not in the displacement.
TEST(PictureParts, GiveTheMeanWayOfAPeriodOverSeveral) {
    const PictureParts parts(scene_with_displacements(), kClock, 0);
    const auto bounced = [](std::int64_t step) {
        return Vec3(0, 0, 0.001 * kClock.cycles(step) + (step / 800 % 2 ? 0.5 : 0));
    };
    const Shot two = picture(parts, {1600, FilmSegment(), 2}, bounced);
    EXPECT_LT((two.displacement.at(0) - Vec3(0, 0, 0.001)).norm(), 1e-12);
    const Shot one = picture(parts, {2400, FilmSegment(), 1}, bounced);
    EXPECT_LT((one.displacement.at(0) - Vec3(0, 0, 0.501)).norm(), 1e-12);
}

TEST(PictureParts, GiveTheMomentsOfAnExposure) {
    FilmSegment rule;
    rule.exposure = 0.04;
    rule.exposures = 4;
    const PictureParts parts(FilmedScene(), kClock, 150);
    EXPECT_THAT(steps_of(parts.moments(400, rule, 1)), testing::ElementsAre(200, 300)) << "100 is before it";
    const Shot now =
        picture(parts, {600, rule}, [](std::int64_t step) { return Vec3(0, 0, static_cast<double>(step)); });
    ASSERT_EQ(now.exposed.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(now.exposed[k]->position.at(0).z(), 300.0 + 100.0 * static_cast<double>(k));
        EXPECT_EQ(now.exposed[k]->size(), 1u) << "grains whole";
        EXPECT_TRUE(now.exposed[k]->exposed.empty()) << "frames would hang on frames";
    }
}

// Place of a grain that shakes with the container and drifts: x = sin(2 pi f t) in all three directions, plus
// v t.
Vec3 shaken(std::int64_t step, const Vec3& drift) {
    const double turn = 2 * std::numbers::pi * kClock.cycles(step);
    return Vec3(0.001, 0.004, 0.005) * std::sin(turn) + drift * kClock.time(step);
}

TEST(PictureParts, OfAMeanLeaveTheDriftAlone) {
    const Vec3 drift(0, 0.02, -0.01);
    constexpr std::int64_t kShot = 4300;
    const PictureParts parts(FilmedScene(), kClock, 0);
    EXPECT_THAT(parts.moments(kShot, mean_of(3), 1), testing::SizeIs(3 * 16)) << "beside its own";
    const Shot now = picture(
        parts, {kShot, mean_of(3)}, [&](std::int64_t step) { return shaken(step, drift); },
        [](std::int64_t step) { return shaken(step, Vec3::Zero()); });
    // The mean of 48 samples, which are 1/16 of a period apart and end now, lags by half of 47 of these
    // intervals.
    const Vec3 expected = drift * (kClock.time(kShot) - 0.5 * 47 * 50 * kClock.step);
    EXPECT_LT((now.position[0] - expected).norm(), 1e-15);
    EXPECT_LT((now.velocity[0] - drift).norm(), 1e-13);
    EXPECT_LT(now.container().place.norm(), 1e-15);
    EXPECT_LT(now.container().velocity.norm(), 1e-13);
}

// The bed repeats itself every second period, so means over one period become means over two.
TEST(PictureParts, OfAMeanSpanThePeriodsOfTheBed) {
    const Vec3 drift(0, 0.02, -0.01);
    constexpr std::int64_t kShot = 4300;
    const auto doubled = [&](std::int64_t step) -> Vec3 {
        return shaken(step, drift) + Vec3(0, 0, 0.003) * std::sin(std::numbers::pi * kClock.cycles(step));
    };
    for (const int periods : {1, 2}) {
        const Shot frame =
            picture(PictureParts(FilmedScene(), kClock, 0), {kShot, mean_of(1), periods}, doubled);
        const double error = (frame.velocity[0] - drift).norm();
        if (periods == 2)
            EXPECT_LT(error, 1e-12);
        else
            EXPECT_GT(error, 0.01);
        // The mean is over 16 moments spread over those periods; the last one is the shot's own.
        Vec3 mean = Vec3::Zero();
        for (int k = 0; k < 16; ++k) mean += doubled(kShot - k * periods * kClock.steps_per_period / 16) / 16;
        EXPECT_LT((frame.position[0] - mean).norm(), 1e-12);
    }
}

TEST(PictureParts, OfAMeanGoTheShortWayRoundAPeriodicContainer) {
    constexpr double kDepth = 0.04;
    FilmedScene scene;
    scene.container.periodic_depth = true;
    scene.container.depth = kDepth;
    const Vec3 drift(0.1, 0, 0);
    const auto wrapped = [&](std::int64_t step) {
        Vec3 at = drift * kClock.time(step) + Vec3(0.019, 0, 0);
        at.x() -= kDepth * std::round(at.x() / kDepth);
        return at;
    };
    for (const std::int64_t shot : {800, 1600}) {  // in the first period the grain passes the end at 0.01 s
        const Shot now = picture(PictureParts(scene, kClock, 0), {shot, mean_of(1)}, wrapped);
        double expected = 0.1 * (kClock.time(shot) - 0.5 * 15 * 50 * kClock.step) + 0.019;
        expected -= kDepth * std::round(expected / kDepth);
        EXPECT_NEAR(now.position[0].x(), expected, 1e-15) << shot;
        EXPECT_NEAR(now.velocity[0].x(), 0.1, 1e-12) << shot;
    }
}

TEST(PictureParts, OfAMeanTakeTheBedToHaveRestedBeforeTheRun) {
    const Shot now = picture(PictureParts(FilmedScene(), kClock, 0), {400, mean_of(1)},
                             [](std::int64_t step) { return Vec3(0, 0, 1e-5 * static_cast<double>(step)); });
    double expected = 0;  // 9 samples are from step 0 to 400, and 7 are at rest
    for (int k = 0; k <= 8; ++k) expected += 1e-5 * 50 * k / 16;
    EXPECT_NEAR(now.position[0].z(), expected, 1e-15);
}

// If the source lacks a moment, no part is made of the others.
TEST(PictureParts, LeaveOutWhatIsNotToBeHad) {
    const PictureParts parts(scene_with_displacements(), kClock, 0);
    Shot now = frame_at(1600, Vec3(1, 2, 3));
    parts.add(now, mean_of(1), 1, {}, any_moment(at_rest, at_rest, 1500));
    EXPECT_EQ(now.position[0], Vec3(1, 2, 3));
    EXPECT_TRUE(now.displacement.empty());
}

// A grain that came or left meanwhile has no displacement. Grains that were there all the time have theirs.
TEST(PictureParts, LeaveOutWaysOfGrainsThatHaveComeOrGone) {
    const PictureParts parts(scene_with_displacements(), kClock, 0);
    const auto with = [](State frame, std::int32_t id, const Vec3& at) {
        frame.id.push_back(id);
        frame.position.push_back(at);
        frame.velocity.emplace_back(0, 0, 0);
        return frame;
    };
    const OtherMoments before = [&](std::int64_t step) {
        return std::make_shared<const State>(with(frame_at(step, Vec3(0, 0, 1)), 1, Vec3(7, 8, 9)));
    };
    Shot now = with(frame_at(1600, Vec3(0, 0, 3)), 2, Vec3(4, 5, 6));
    parts.add(now, mean_of(1), 1, {}, before);
    EXPECT_EQ(now.position[1], Vec3(4, 5, 6));
    EXPECT_EQ(now.velocity[1], Vec3(0, 0, 0));
    EXPECT_LT(now.position[0].z(), 3) << "a mean with where it was before";
    ASSERT_EQ(now.displacement.size(), 2u);
    EXPECT_GT(now.displacement[0].z(), 0);
    EXPECT_TRUE(now.displacement[1].hasNaN());
}

TEST(KeptStates, AreKeptUntilTheLastPictureThatWantsThem) {
    KeptStates kept;
    kept.want(40, {{10, true}, {20, false}});
    kept.want(50, {{20, true}, {30, false}});
    EXPECT_THAT(kept.steps(), testing::ElementsAre(10, 20, 30));
    for (const std::int64_t step : {10, 15, 20, 30}) kept.keep(frame_at(step, Vec3(0, 0, 1)));
    EXPECT_FALSE(kept.at(15)) << "nobody wants it";
    EXPECT_EQ(kept.at(20)->velocity.size(), 1u) << "one of two wants it whole";
    EXPECT_TRUE(kept.at(30)->velocity.empty()) << "places alone";
    EXPECT_EQ(kept.at(30)->position.size(), 1u);
    kept.done_with(40);
    EXPECT_FALSE(kept.at(10));
    EXPECT_TRUE(kept.at(20));
    kept.done_with(50);
    EXPECT_FALSE(kept.at(20) || kept.at(30));
    Agenda agenda({12}, 0, 0, 2, 12, {2});
    EXPECT_TRUE(agenda.next()->moment);  // step 2
    EXPECT_FALSE(agenda.next()->moment);
}

// The grain goes from 1 to 4 mm in a period; two pictures on its way stand at 2 and at 3 mm, through the
// periodic wall.
TEST(PictureParts, PutGrainsOnTheirWayBetweenLockedMoments) {
    FilmedScene scene;
    scene.container.periodic_depth = true;
    scene.container.depth = 0.04;
    const PictureParts parts(scene, kClock, 0);
    FilmSegment rule;
    rule.kind = FilmSegment::Kind::locked;
    rule.between = 2;
    const auto moved = [](std::int64_t step) {
        return step <= 800 ? Vec3(0.0185, 0, 0.001) : Vec3(-0.0185, 0, 0.004);
    };
    EXPECT_THAT(steps_of(parts.moments(1598, rule, 1)), testing::ElementsAre(800));
    EXPECT_TRUE(parts.moments(1600, rule, 1).empty());
    const Shot first = picture(parts, {1598, rule}, moved), second = picture(parts, {1599, rule}, moved);
    EXPECT_LT((first.position[0] - Vec3(0.0195, 0, 0.002)).norm(), 1e-12) << first.position[0];
    EXPECT_LT((second.position[0] - Vec3(-0.0195, 0, 0.003)).norm(), 1e-12) << second.position[0];
    EXPECT_EQ(picture(parts, {1600, rule}, moved).position[0], moved(1600));
}

}  // namespace
}  // namespace grainreel
