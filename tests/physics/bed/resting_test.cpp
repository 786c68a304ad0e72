// Tests of closed forms of rolling, sliding and resting on a floor.
#include <gtest/gtest.h>

#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

constexpr double kGravity = 9.81;

// A ball in equilibrium on the loading branch of the floor's spring.
HandMadeBed ball_on_floor(double mu, const Vec3& gravity,
                          TangentialLaw law = TangentialLaw::incremental_slip) {
    HandMadeBed w = make_world(walton_braun_pair(0.9, mu), 2e-6, NormalForce::walton_braun, law);
    w.around.faces = {floor_face()};
    w.around.gravity = gravity;
    const double sink = sphere_mass() * -gravity.z() / kStiffness;
    w.grains.add(0, 0, Vec3(0, 0, kRadius - sink), kRadius, kDensity);
    return w;
}

TEST(OnTheFloor, SlidingTurnsToRolling) {
    const double mu = 0.3, u0 = 0.1;
    HandMadeBed w = ball_on_floor(mu, {0, 0, -kGravity}, TangentialLaw::linear_spring);
    w.grains.motion[0].velocity = Vec3(u0, 0, 0);
    w.start();
    const double time = 2 * u0 / (7 * mu * kGravity);
    w.run(static_cast<std::int64_t>(0.9 * time / w.plan.clock.step));
    EXPECT_GT(w.velocity(0).x(), kRadius * w.spin(0).y() * 1.05) << "it rolls too early";
    w.run(static_cast<std::int64_t>(0.1 * time / w.plan.clock.step));
    EXPECT_NEAR(w.position(0).x(), 12 * u0 * u0 / (49 * mu * kGravity), 2e-3 * u0 * time);
    w.run(static_cast<std::int64_t>(0.5 * time / w.plan.clock.step));
    EXPECT_NEAR(w.velocity(0).x(), 5 * u0 / 7, 2e-3 * u0);
    EXPECT_NEAR(w.spin(0).y() * kRadius, 5 * u0 / 7, 4e-3 * u0);
}

TEST(OnTheFloor, RollsDownAnInclineAtFiveSevenths) {
    const double mu = 0.3, angle = std::atan(0.5 * 3.5 * mu);
    HandMadeBed w = ball_on_floor(mu, kGravity * Vec3(std::sin(angle), 0, -std::cos(angle)));
    w.start();
    const std::int64_t steps = 50000;
    w.run(steps);
    const double time = static_cast<double>(steps) * w.plan.clock.step;
    EXPECT_NEAR(w.velocity(0).x(), 5.0 / 7 * kGravity * std::sin(angle) * time, 2e-3 * kGravity * time);
}

TEST(OnTheFloor, SlidesDownAnInclineThatIsTooSteepToRoll) {
    const double mu = 0.1, angle = std::atan(2 * 3.5 * mu);
    HandMadeBed w = ball_on_floor(mu, kGravity * Vec3(std::sin(angle), 0, -std::cos(angle)));
    w.start();
    const std::int64_t steps = 50000;
    w.run(steps);
    const double expected = kGravity * (std::sin(angle) - mu * std::cos(angle));
    EXPECT_NEAR(w.velocity(0).x() / (static_cast<double>(steps) * w.plan.clock.step), expected,
                2e-3 * expected);
}

TEST(OnTheFloor, RollingWithoutSlipMeetsNoFriction) {
    HandMadeBed w = ball_on_floor(0.5, {0, 0, -kGravity});
    const double arm = w.grains.place[0].position.z();
    w.grains.motion[0].velocity = Vec3(0.1, 0, 0);
    w.grains.motion[0].spin = Vec3(0, 0.1 / arm, 0);
    w.start();
    w.run(10000);
    double friction = -1;
    w.loop->visit_contacts(w.step, [&](const ContactView& c) { friction = c.tangential.norm(); });
    ASSERT_GE(friction, 0);
    EXPECT_LT(friction, 1e-9 * sphere_mass() * kGravity);
}

TEST(OnTheFloor, SpringDashpotBallRestsAtItsWeightOverStiffness) {
    PairPlan pair = walton_braun_pair(0.7, 0);
    pair.unloading_stiffness = pair.loading_stiffness;
    pair.normal_damping = 0.2 * 2 * std::sqrt(kStiffness / sphere_mass());
    HandMadeBed w = make_world(pair, 1e-6, NormalForce::spring_dashpot, TangentialLaw::none);
    w.around.faces = {floor_face()};
    w.around.gravity = {0, 0, -kGravity};
    w.grains.add(0, 0, Vec3(0, 0, 1.1 * kRadius), kRadius, kDensity);
    w.start();
    w.run(400000);
    const double sink = sphere_mass() * kGravity / kStiffness;
    EXPECT_NEAR(kRadius - w.position(0).z(), sink, 1e-4 * sink);
}

// A Walton-Braun ball that is released when it touches swings for ever between 2(1 - e^2) mg/K1 and 2 mg/K1.
TEST(OnTheFloor, WaltonBraunBallSwingsOnItsLatchedBranch) {
    const double e = 0.7;
    HandMadeBed w = make_world(walton_braun_pair(e, 0), 1e-7, NormalForce::walton_braun, TangentialLaw::none);
    w.around.faces = {floor_face()};
    w.around.gravity = {0, 0, -kGravity};
    w.grains.add(0, 0, Vec3(0, 0, kRadius), kRadius, kDensity);
    w.start();
    w.run(40000);
    const double sink = sphere_mass() * kGravity / kStiffness;
    double lowest = INFINITY, highest = 0, sum = 0;
    const int samples = 40000;
    for (int k = 0; k < samples; ++k) {
        w.run(1);
        const double overlap = kRadius - w.position(0).z();
        lowest = std::min(lowest, overlap);
        highest = std::max(highest, overlap);
        sum += overlap;
    }
    EXPECT_NEAR(highest, 2 * sink, 0.002 * sink);
    EXPECT_NEAR(lowest, 2 * (1 - e * e) * sink, 0.002 * sink);
    EXPECT_NEAR(sum / samples, (2 - e * e) * sink, 0.02 * sink);
}

}  // namespace
}  // namespace grainreel
