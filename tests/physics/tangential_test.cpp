// Walton's incremental slip, called by hand.
#include <gtest/gtest.h>

#include "engine/laws/contact_law.hpp"
#include "engine/laws/incremental_slip.hpp"
#include "engine/laws/walton_braun.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

constexpr double kFriction = 0.4, kNormal = 2.0;  // -, N

struct Sheared {
    IncrementalSlip::Parameters parameters;
    WaltonBraun::Parameters normal;
    IncrementalSlip::History history;
    Touch touch{};

    explicit Sheared(double gamma)
        : parameters([&] {
              PairPlan p = walton_braun_pair(0.8, kFriction);
              p.gamma = gamma;
              return p;
          }()),
          normal(walton_braun_pair(0.8, kFriction)) {
        touch.normal = Vec3(0, 0, 1);
        touch.slip = touch.slip_velocity = Vec3::Zero();
    }
    // T along x after slipping by `s` in `steps` equal parts.
    double slip(double s, int steps, double normal_force = kNormal) {
        for (int k = 0; k < steps; ++k) {
            touch.slip = Vec3(s / steps, 0, 0);
            IncrementalSlip::force(parameters, normal, history, touch, normal_force);
        }
        return history.force.x();
    }
};

// dT/ds = K0 (1 - T/(mu N))^gamma from rest: T/(mu N) = 1 - (1 - (1 - gamma) x)^(1/(1 - gamma)), x = K0 s/(mu
// N); for gamma = 1, 1 - exp(-x).
double virgin_loading(double gamma, double slip, double stiffness) {
    const double limit = kFriction * kNormal, x = stiffness * slip / limit;
    if (gamma == 1) return limit * (1 - std::exp(-x));
    const double base = 1 - (1 - gamma) * x;
    return base <= 0 ? limit : limit * (1 - std::pow(base, 1 / (1 - gamma)));
}

TEST(IncrementalSlip, LoadsAlongTheIntegralOfItsStiffness) {
    for (const double gamma : {1.0 / 3.0, 1.0, 2.0}) {
        Sheared s(gamma);
        const double slip = 0.8 * kFriction * kNormal / s.parameters.stiffness;
        EXPECT_NEAR(s.slip(slip, 20000), virgin_loading(gamma, slip, s.parameters.stiffness), 1e-4) << gamma;
    }
}

// Unloading from T0: with u = T0 - T, du/d(-s) = K0 (1 - u/(mu N + T0))^gamma: the loading curve, stretched.
TEST(IncrementalSlip, UnloadsFromItsTurningPointThroughZero) {
    Sheared s(1.0);
    const double limit = kFriction * kNormal;
    const double top = s.slip(1.0 * limit / s.parameters.stiffness, 20000);
    const double back = 1.5 * limit / s.parameters.stiffness;
    const double expected =
        top - (limit + top) * (1 - std::exp(-s.parameters.stiffness * back / (limit + top)));
    ASSERT_LT(expected, 0) << "it should pass zero";
    EXPECT_NEAR(s.slip(-back, 20000), expected, 2e-4 * limit);
    EXPECT_NEAR(s.history.turning_force, -top, 1e-9) << "T* changes sign with the direction";
    // And forward again from there: T* takes the force at the new turning point.
    const double bottom = std::abs(s.history.force.x());
    s.slip(1e-9, 1);
    EXPECT_NEAR(s.history.turning_force, bottom, 1e-9);
    EXPECT_EQ(s.history.growing, -1);
}

TEST(IncrementalSlip, NeverPassesCoulombsLimit) {
    for (const double gamma : {1.0 / 3.0, 2.0}) {
        Sheared s(gamma);
        s.slip(100 * kFriction * kNormal / s.parameters.stiffness, 57);
        EXPECT_LE(s.history.force.norm(), kFriction * kNormal * (1 + 1e-12));
        s.slip(0, 1, 0.5 * kNormal);  // the normal force falls: so does the cap
        EXPECT_LE(s.history.force.norm(), 0.5 * kFriction * kNormal * (1 + 1e-12));
        s.slip(0, 1, 0);
        EXPECT_EQ(s.history.force.norm(), 0);
        EXPECT_EQ(s.history.turning_force, 0);
        s.slip(1e-7, 1, kNormal);
        EXPECT_TRUE(s.history.force.allFinite());
    }
}

TEST(IncrementalSlip, IsLinearAndUncappedWithInfiniteFriction) {
    PairPlan plan = walton_braun_pair(0.8, INFINITY);
    IncrementalSlip::Parameters p(plan);
    WaltonBraun::Parameters n(plan);
    IncrementalSlip::History h;
    Touch touch{};
    touch.normal = Vec3(0, 0, 1);
    touch.slip = Vec3(0, 3e-5, 0);
    for (int k = 0; k < 10; ++k) IncrementalSlip::force(p, n, h, touch, kNormal);
    EXPECT_NEAR(h.force.y(), plan.tangential_stiffness * 3e-4, 1e-9);
}

// A touching pair that turns as one body: T turns with it, |T| constant, also when it spins about its own
// axis.
TEST(IncrementalSlip, TurnsWithTheContact) {
    const Vec3 axis = Vec3(1, 2, -0.5).normalized();
    Sheared s(1.0 / 3.0);
    s.slip(0.5 * kFriction * kNormal / s.parameters.stiffness, 100);
    const Vec3 force = s.history.force, normal = s.touch.normal;
    const double size = force.norm();
    const int steps = 2000;
    const double angle = 2.5;  // rad
    s.touch.slip.setZero();
    for (int k = 1; k <= steps; ++k) {
        s.touch.normal = Eigen::AngleAxisd(angle * k / steps, axis) * normal;
        s.touch.twist =
            angle / steps * axis.dot(Vec3(Eigen::AngleAxisd(angle * (k - 0.5) / steps, axis) * normal));
        IncrementalSlip::force(s.parameters, s.normal, s.history, s.touch, kNormal);
        ASSERT_NEAR(s.history.force.norm(), size, 1e-12 * size);
    }
    const Vec3 expected = Eigen::AngleAxisd(angle, axis) * force;
    EXPECT_LT((s.history.force - expected).norm(), 1e-5 * size);
}

TEST(IncrementalSlip, GivesTheSameForceWhenTheBodiesChangePlaces) {
    Sheared s(1.0 / 3.0);
    s.slip(1e-6, 10);
    Sheared other = s;
    other.history.flip();
    other.touch.normal = -s.touch.normal;
    s.touch.slip = Vec3(-3e-7, 2e-7, 0);
    other.touch.slip = -s.touch.slip;
    const Vec3 one = IncrementalSlip::force(s.parameters, s.normal, s.history, s.touch, 1.1 * kNormal);
    const Vec3 two =
        IncrementalSlip::force(other.parameters, other.normal, other.history, other.touch, 1.1 * kNormal);
    EXPECT_EQ(one, Vec3(-two));
}

}  // namespace
}  // namespace grainreel
