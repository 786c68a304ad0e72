// The health check: it stops what is no longer physics, says where, and lets be what is.
#include "engine/measure/health.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

using testing::HasSubstr;

class HealthCheck : public testing::Test {
  protected:
    void SetUp() override {
        limits.clock.step = w.plan.clock.step;
        limits.species = {"big"};
        w.around.faces = {floor_face()};
        w.grains.add(0, 0, Vec3(0, 0, 3 * kRadius), kRadius, kDensity);
        w.grains.add(1, 0, Vec3(3 * kRadius, 0, 3 * kRadius), kRadius, kDensity);
    }
    std::string complaint() {
        if (!w.loop) w.start();
        try {
            check_state(limits, w.around, w.grains, *w.loop, 1234);
        } catch (const RunError& error) {
            return error.what();
        }
        return "";
    }

    World w = make_world(walton_braun_pair(0.9, 0.3), 1e-6);
    HealthLimits limits;
};

TEST_F(HealthCheck, SaysNothingOfASoundState) {
    w.grains.place[1].position.x() = 2 * kRadius - 0.32 * kRadius;
    EXPECT_EQ(complaint(), "");
}

TEST_F(HealthCheck, StopsAtAnOverlapOfAThirdOfARadius) {
    w.grains.place[1].position.x() = 2 * kRadius - 0.35 * kRadius;
    const std::string said = complaint();
    EXPECT_THAT(said, HasSubstr("step 1234"));
    EXPECT_THAT(said, HasSubstr("grain 0 (big) at (0, 0, 0.006) m overlaps grain 1 by 0.35"));
    EXPECT_THAT(said, HasSubstr("take a larger contact.stiffness or a smaller run.step"));
}

TEST_F(HealthCheck, StopsAtAnOverlapWithAWall) {
    w.grains.place[1].position.z() = 0.6 * kRadius;
    EXPECT_THAT(complaint(), HasSubstr("overlaps the floor by 0.40"));
}

TEST_F(HealthCheck, StopsAtWhatIsNoNumber) {
    w.start();
    w.grains.motion[w.index_of(1)].velocity.y() = NAN;
    EXPECT_THAT(complaint(), HasSubstr("grain 1 (big)"));
    EXPECT_THAT(complaint(), HasSubstr("is no longer a number"));
}

TEST_F(HealthCheck, StopsAtAGrainBehindAWall) {
    w.grains.place[1].position.z() = -1.1 * kRadius;
    EXPECT_THAT(complaint(), HasSubstr("went through the floor"));
}

TEST_F(HealthCheck, LetsWallsGiveEnergyAndStopsAtMore) {
    EnergyWatch watch;
    const auto check = [&](double energy, double work) {
        watch.check(energy, work, 1e-3, limits, w.grains, 100);
    };
    check(1.0, 0.0);
    check(2.5, 1.6);  // 1.6 J of work, 0.1 J lost
    EXPECT_THROW(check(2.7, 1.6), RunError);
    EXPECT_NO_THROW(check(2.55, 1.6));
    w.grains.motion[0].velocity.x() = std::sqrt(2 * 3.0 / sphere_mass());  // 3 J of motion
    EXPECT_NO_THROW(check(2.7, 1.6));
}

}  // namespace
}  // namespace grainreel
