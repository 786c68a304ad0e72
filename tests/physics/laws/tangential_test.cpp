// Tests of Walton's incremental slip, called by hand.
#include <gtest/gtest.h>

#include "engine/laws/contact_law-inl.hpp"
#include "engine/laws/incremental_slip-inl.hpp"
#include "engine/laws/walton_braun-inl.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

using namespace HWY_NAMESPACE;
using Vector = Triple<double>;

Vector along(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}
double size(const Vector& v) {
    return std::sqrt(v.squared());
}

constexpr double kFriction = 0.4, kNormal = 2.0;  // -, N

struct Sheared {
    IncrementalSlip::Parameters<double> parameters;
    WaltonBraun::Parameters<double> normal;
    IncrementalSlip::History<double> history{};
    Touch<double> touch{};

    explicit Sheared(double gamma)
        : parameters([&] {
              PairPlan p = walton_braun_pair(0.8, kFriction);
              p.gamma = gamma;
              return IncrementalSlip::from(p);
          }()),
          normal(WaltonBraun::from(walton_braun_pair(0.8, kFriction))) {
        touch.normal = {0, 0, 1};
    }
    // T along x after slipping by `s` in `steps` equal parts.
    double slip(double s, int steps, double normal_force = kNormal) {
        for (int k = 0; k < steps; ++k) {
            touch.slip = {s / steps, 0, 0};
            IncrementalSlip::force(parameters, normal, history, touch, normal_force);
        }
        return history.force.x;
    }
};

// dT/ds = K0 (1 - T/(mu N))^gamma from rest gives T/(mu N) = 1 - (1 - (1 - gamma) x)^(1/(1 - gamma)), where x
// = K0 s/(mu N); for gamma = 1 it is 1 - exp(-x).
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

// Unloading from T0: with u = T0 - T, du/d(-s) = K0 (1 - u/(mu N + T0))^gamma. This is the loading curve,
// stretched.
TEST(IncrementalSlip, UnloadsFromItsTurningPointThroughZero) {
    Sheared s(1.0);
    const double limit = kFriction * kNormal;
    const double top = s.slip(1.0 * limit / s.parameters.stiffness, 20000);
    const double back = 1.5 * limit / s.parameters.stiffness;
    const double expected =
        top - (limit + top) * (1 - std::exp(-s.parameters.stiffness * back / (limit + top)));
    ASSERT_LT(expected, 0) << "it should pass zero";
    EXPECT_NEAR(s.slip(-back, 20000), expected, 2e-4 * limit);
    EXPECT_NEAR(s.history.turning_ratio * kNormal, -top, 1e-9) << "T* changes sign with the direction";
    // The slip goes forward again from there, and T* becomes the force at the new turning point.
    const double bottom = std::abs(s.history.force.x);
    s.slip(1e-9, 1);
    EXPECT_NEAR(s.history.turning_ratio * kNormal, bottom, 1e-9);
    EXPECT_EQ(s.history.pressed, -kNormal) << "the sign says that |T| shrinks";
}

TEST(IncrementalSlip, NeverPassesCoulombsLimit) {
    for (const double gamma : {1.0 / 3.0, 2.0}) {
        Sheared s(gamma);
        s.slip(100 * kFriction * kNormal / s.parameters.stiffness, 57);
        EXPECT_LE(size(s.history.force), kFriction * kNormal * (1 + 1e-12));
        s.slip(0, 1, 0.5 * kNormal);  // the normal force falls, and so does the limit
        EXPECT_LE(size(s.history.force), 0.5 * kFriction * kNormal * (1 + 1e-12));
        s.slip(0, 1, 0);
        EXPECT_EQ(size(s.history.force), 0);
        EXPECT_EQ(s.history.turning_ratio, 0);
        s.slip(1e-7, 1, kNormal);
        EXPECT_TRUE(std::isfinite(size(s.history.force)));
    }
}

// The contact slides, its normal force falls while it turns back, and it slips forward again: T* is mu N. If
// it is pressed harder, T* grows with N and T does not, so T can grow again.
TEST(IncrementalSlip, TakesHoldAgainWhenPressedHarderAfterATurnAtTheLimit) {
    Sheared s(1.0);
    const double limit = kFriction * kNormal, slip = 1e-3 * limit / s.parameters.stiffness;
    s.slip(100 * limit / s.parameters.stiffness, 57);
    s.slip(-slip, 1, 0.5 * kNormal);
    EXPECT_NEAR(s.slip(slip, 1, 0.5 * kNormal), 0.5 * limit, 1e-12);
    EXPECT_NEAR(s.history.turning_ratio, kFriction, 1e-12);
    EXPECT_NEAR(s.slip(slip, 1), (0.5 + 1e-3) * limit, 1e-9 * limit) << "with all of K0";
    EXPECT_GT(s.slip(2000 * slip, 2000), 0.99 * limit);
}

TEST(IncrementalSlip, IsLinearAndUncappedWithInfiniteFriction) {
    const PairPlan plan = walton_braun_pair(0.8, INFINITY);
    Sheared s(1.0 / 3.0);
    s.parameters = IncrementalSlip::from(plan);
    const double slip = 3e-4;
    EXPECT_NEAR(s.slip(slip, 10), plan.tangential_stiffness * slip, 1e-9);
    EXPECT_EQ(s.slip(slip, 1, 0), 0) << "without a normal force nothing holds";
}

// In a touching pair that turns as one body, T turns with it and |T| is constant, also when the pair spins
// about its own axis.
TEST(IncrementalSlip, TurnsWithTheContact) {
    const Vec3 axis = Vec3(1, 2, -0.5).normalized(), normal(0, 0, 1);
    Sheared s(1.0 / 3.0);
    s.slip(0.5 * kFriction * kNormal / s.parameters.stiffness, 100);
    const Vec3 force(s.history.force.x, s.history.force.y, s.history.force.z);
    const int steps = 2000;
    const double angle = 2.5;  // rad
    s.touch.slip = {0, 0, 0};
    s.touch.turn = along(std::tan(0.5 * angle / steps) * axis);
    for (int k = 1; k <= steps; ++k) {
        s.touch.normal = along(Eigen::AngleAxisd(angle * k / steps, axis) * normal);
        IncrementalSlip::force(s.parameters, s.normal, s.history, s.touch, kNormal);
        ASSERT_NEAR(size(s.history.force), force.norm(), 1e-12 * force.norm());
    }
    const Vector expected = along(Eigen::AngleAxisd(angle, axis) * force);
    EXPECT_LT(size(s.history.force - expected), 1e-12 * force.norm());
}

TEST(IncrementalSlip, GivesTheSameForceWhenTheBodiesChangePlaces) {
    Sheared s(1.0 / 3.0);
    s.slip(1e-6, 10);
    Sheared other = s;
    other.history.force = -s.history.force;
    other.touch.normal = -s.touch.normal;
    s.touch.slip = {-3e-7, 2e-7, 0};
    other.touch.slip = -s.touch.slip;
    const Vector one = IncrementalSlip::force(s.parameters, s.normal, s.history, s.touch, 1.1 * kNormal);
    const Vector two =
        IncrementalSlip::force(other.parameters, other.normal, other.history, other.touch, 1.1 * kNormal);
    EXPECT_EQ(size(one + two), 0);
}

}  // namespace
}  // namespace grainreel
