#include "render/run/moments/earlier_positions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/run/moments/agenda.hpp"

namespace grainreel {
namespace {

Frame frame_at(std::int64_t step, const Vec3& position) {
    Frame frame;
    frame.step = step;
    frame.id = {0};
    frame.position = {position};
    return frame;
}

TEST(EarlierPositions, AreWantedOnePeriodBeforeEachPicture) {
    const EarlierPositions earlier({{0, 0}, {7, 0}, {12, 0}, {12, 1}, {30, 1}}, 10, {1}, 2, 0);
    EXPECT_THAT(earlier.steps(), testing::ElementsAre(2, 20));
    Agenda agenda({{12, 0}}, 0, 0, 2, 12, earlier.steps());
    EXPECT_TRUE(agenda.next()->moment);  // step 2
    const std::optional<Stop> picture = agenda.next();
    EXPECT_EQ(picture->step, 12);
    EXPECT_FALSE(picture->moment);
}

TEST(EarlierPositions, GiveTheWayOfAPeriod) {
    EarlierPositions earlier({{10, 0}, {15, 0}}, 10, {1}, 0, 0.04);
    earlier.keep(frame_at(0, {0.019, 0, 0.1}));
    Frame now = frame_at(10, {-0.018, 0.002, 0.11});  // through the periodic wall: 3 mm, not -37
    earlier.fill(now, 1);
    ASSERT_EQ(now.displacement.size(), 1u);
    EXPECT_LT((now.displacement[0] - Vec3(0.003, 0.002, 0.01)).norm(), 1e-12);
    Frame unknown = frame_at(15, {0, 0, 0});
    earlier.fill(unknown, 1);
    EXPECT_TRUE(unknown.displacement.empty());
}

// A bed that repeats itself every second period: what it does in between is not in its way.
TEST(EarlierPositions, GiveTheMeanWayOfAPeriodOverSeveral) {
    EarlierPositions earlier({{20, 0}, {30, 0}, {40, 0}}, 10, {1, 2}, 0, 0);
    EXPECT_THAT(earlier.steps(), testing::ElementsAre(0, 10, 20, 30));
    const auto bounced = [](std::int64_t step) {
        return Vec3(0, 0, 0.001 * static_cast<double>(step) + (step / 10 % 2 ? 0.5 : 0));
    };
    for (const std::int64_t step : {0, 10, 20}) earlier.keep(frame_at(step, bounced(step)));
    Frame two = frame_at(20, bounced(20)), one = frame_at(30, bounced(30)), four = frame_at(40, bounced(40));
    earlier.fill(two, 2);
    EXPECT_LT((two.displacement.at(0) - Vec3(0, 0, 0.01)).norm(), 1e-12);
    earlier.fill(one, 1);
    EXPECT_LT((one.displacement.at(0) - Vec3(0, 0, 0.51)).norm(), 1e-12);
    earlier.leave_out(40);
    earlier.fill(four, 2);
    EXPECT_TRUE(four.displacement.empty()) << "kept for a picture that was left out";
}

}  // namespace
}  // namespace grainreel
