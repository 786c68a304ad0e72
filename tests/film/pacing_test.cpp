// Tests of the words about how fast a film plays, found from its frames.
#include "render/film/sampling/timeline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "render/film/sampling/sampler.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;

// Moments of `count` frames, one every `every` steps from the step `first` on, by a clock of 20 Hz.
std::vector<State> moments(int count, std::int64_t every, std::int64_t first = 0, std::int64_t period = 800) {
    const Clock clock{1 / (20.0 * static_cast<double>(period)), period, 0};
    std::vector<State> frames;
    for (int i = 0; i < count; ++i) {
        State frame;
        frame.step = first + i * every;
        frame.time = clock.time(frame.step);
        frame.phase = clock.phase(frame.step);
        frame.cycles = clock.cycles(frame.step);
        frames.push_back(frame);
    }
    return frames;
}

Drive drive_of(double frequency) {
    Drive drive;
    drive.present = frequency > 0;
    drive.frequency = frequency;
    return drive;
}

std::string caption(const std::vector<State>& frames, double frequency = 20, double rate = 30) {
    const auto segment = pacing_of(frames, drive_of(frequency), rate);
    return segment ? playback_caption(*segment, drive_of(frequency), rate) : "none";
}

TEST(Pacing, AgreeingPhasesAreALockedFilm) {
    EXPECT_EQ(caption(moments(5, 800)), "1 frame a period at phase 0 (plays 1.5×)");
    EXPECT_EQ(caption(moments(5, 800, 200)), "1 frame a period at phase 0.25 (plays 1.5×)");
    EXPECT_EQ(caption(moments(5, 2400, 799)), "1 frame every 3 periods at phase 0.999 (plays 4.5×)");
}

TEST(Pacing, OtherwiseTheFactorFollowsFromTheInterval) {
    EXPECT_EQ(caption(moments(9, 100)), "slow motion, 0.188 speed");   // 1/160 s x 30 frames/s
    EXPECT_EQ(caption(moments(9, 80)), "slow motion, 0.15 speed");     // 1/200 s
    EXPECT_EQ(caption(moments(9, 800), 0), "time lapse, 1.5× speed");  // no drive, no phase
    EXPECT_EQ(caption(moments(9, 1600, 0), 0, 20), "time lapse, 2× speed");
    EXPECT_EQ(caption(moments(9, 160, 0), 20, 10), "slow motion, 1/10 speed");
}

// The moments of a panel of 25 Hz follow those of 20 Hz: it shows every period, but leaves one out now and
// then.
TEST(Pacing, WhereFramesComeUnevenlyTheirMeanIsSaid) {
    std::vector<State> frames;
    const Clock clock{1 / 25.0 / 640, 640, 0};
    for (const std::int64_t period : {0, 1, 3, 4, 5}) {
        State frame;
        frame.step = 640 * period;
        frame.time = clock.time(frame.step);
        frames.push_back(frame);
    }
    EXPECT_EQ(caption(frames, 25), "none");
    EXPECT_EQ(pacing_caption(frames, drive_of(25), 30),
              "on average 1 frame every 1.25 periods at phase 0 (plays 1.5×)");
    frames[2].phase = 0.5;  // (5/25 s) / 4 frames x 30 frames/s = 1.5
    EXPECT_EQ(pacing_caption(frames, drive_of(25), 30), "on average time lapse, 1.5× speed");
    EXPECT_EQ(pacing_caption(moments(5, 800), drive_of(20), 30), caption(moments(5, 800)));
}

// 1/30 s is not a whole number of steps of 1/16000 s: 533 make 0.99938 of it.
TEST(Pacing, RoundingToStepsDoesNotHideThePlainFactor) {
    EXPECT_EQ(caption(moments(9, 533), 20), "real time");
    EXPECT_EQ(caption(moments(9, 53), 20), "slow motion, 1/10 speed");
    EXPECT_EQ(caption(moments(9, 530), 20),
              "slow motion, 0.994 speed");  // three steps of difference are meant
}

TEST(Pacing, DurationIsThatOfTheFrames) {
    EXPECT_DOUBLE_EQ(*pacing_of(moments(5, 800, 400), drive_of(20), 30)->duration, 0.2);
}

TEST(Pacing, OneFrameOrUnevenOnesHaveNone) {
    EXPECT_EQ(caption(moments(1, 800)), "none");
    std::vector<State> uneven = moments(4, 80);
    uneven.erase(uneven.begin() + 1);
    EXPECT_EQ(caption(uneven), "none");
}

// 16 steps of 21 make a period of 20 Hz ... at a rate of 1.05 times the period: |20 - 1 x 19.05| = 0.952 Hz.
TEST(Pacing, WarnsWhereTheFilmWouldLie) {
    const auto warning = pacing_warning(moments(9, 840), drive_of(20));
    ASSERT_TRUE(warning.has_value());
    EXPECT_THAT(*warning, tells({"20 Hz", "seem to move", "0.9524 Hz"}));
    EXPECT_THAT(*warning, tells({"trajectory_interval", "0.00625 s or less"}));
    EXPECT_FALSE(pacing_warning(moments(9, 800), drive_of(20)).has_value());
    EXPECT_FALSE(pacing_warning(moments(9, 100), drive_of(20)).has_value());
    EXPECT_TRUE(pacing_warning(moments(9, 101), drive_of(20)).has_value());
    EXPECT_FALSE(pacing_warning(moments(9, 840), drive_of(0)).has_value());
}

}  // namespace
}  // namespace grainreel
