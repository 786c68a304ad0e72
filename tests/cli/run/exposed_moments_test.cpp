#include "render/run/moments/exposed_moments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace grainreel {
namespace {

Frame frame_at(std::int64_t step) {
    Frame frame;
    frame.step = step;
    return frame;
}

std::vector<std::int64_t> steps_of(const std::vector<FramePtr>& frames) {
    std::vector<std::int64_t> steps;
    for (const FramePtr& frame : frames) steps.push_back(frame->step);
    return steps;
}

TEST(ExposedMoments, AreKeptUntilTheirPicture) {
    Film film;
    film.segments.resize(2);
    film.segments[0].exposure = 0.04;
    film.segments[0].exposures = 4;
    const Clock clock{1e-3, 0, 0};
    ExposedMoments exposed({{5, 0}, {40, 0}, {50, 0}, {60, 1}}, film.segments, clock, {1}, 2);
    // Of the first picture only what the run has; the second and the third share two moments.
    EXPECT_THAT(exposed.steps(), testing::ElementsAre(10, 20, 30, 40));
    for (const std::int64_t step : {10, 15, 20, 30}) exposed.keep(frame_at(step));
    Frame first = frame_at(5), second = frame_at(40), third = frame_at(50), fourth = frame_at(60);
    exposed.fill(first, 1);
    EXPECT_TRUE(first.exposed.empty());
    exposed.keep(second);
    exposed.fill(second, 1);
    EXPECT_THAT(steps_of(second.exposed), testing::ElementsAre(10, 20, 30));
    exposed.fill(third, 1);
    EXPECT_THAT(steps_of(third.exposed), testing::ElementsAre(20, 30, 40));
    EXPECT_TRUE(third.exposed.back()->exposed.empty()) << "frames would hang on frames";
    exposed.fill(fourth, 1);
    EXPECT_TRUE(fourth.exposed.empty());
}

}  // namespace
}  // namespace grainreel
