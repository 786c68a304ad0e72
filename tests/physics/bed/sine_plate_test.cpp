// Tests of a ball on a plate that moves as a sine, against the closed forms of a point that bounces at once
// (Mehta & Luck 1990, Phys. Rev. Lett. 65, 393; Pieranski 1983, J. Phys. France 44, 573).
#include <gtest/gtest.h>

#include <numeric>

#include "engine/plan/damping.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

constexpr double kGravity = 9.81, kFrequency = 20;

// A world with a step that divides the period and is at most `longest` seconds.
HandMadeBed plate(double g_level, double phase, double ramp, double longest, NormalForce law, PairPlan pair) {
    Drive drive;
    drive.present = true;
    drive.frequency = kFrequency;
    drive.amplitude = g_level * kGravity / std::pow(2 * pi * kFrequency, 2);
    drive.phase = phase;
    drive.ramp = ramp;
    const auto steps = static_cast<std::int64_t>(std::ceil(1 / (kFrequency * longest)));
    HandMadeBed w = make_world(pair, 1 / (kFrequency * static_cast<double>(steps)), law, TangentialLaw::none);
    w.plan.clock.steps_per_period = steps;
    w.plan.clock.initial_phase = phase;
    w.around.faces = {floor_face()};
    w.around.faces[0].body.driven = true;
    w.around.motion = DriveMotion(drive, w.plan.clock);
    w.around.gravity = {0, 0, -kGravity};
    return w;
}

// A ball at rest on the plate stays there as long as the plate never falls faster than the ball would.
TEST(SinePlate, BallLeavesAtOneG) {
    for (const double g_level : {0.98, 1.02}) {
        PairPlan pair = walton_braun_pair(1, 0);
        pair.normal_damping = 0.2 * std::sqrt(kStiffness / sphere_mass());
        HandMadeBed w = plate(g_level, 0, 3, 5e-6, NormalForce::spring_dashpot, pair);
        w.grains.add(0, 0, Vec3(0, 0, kRadius - sphere_mass() * kGravity / kStiffness), kRadius, kDensity);
        w.start();
        bool left = false;
        while (w.step < 5 * w.plan.clock.steps_per_period) {
            w.run(1);
            left = left || w.grains.load[0].force.z() == 0;
        }
        EXPECT_EQ(left, g_level > 1) << g_level;
    }
}

// Flight times in periods, from touch to touch. The ball leaves the plate at `phase` (turns) with a velocity
// that brings it back after n periods, if the plate is then as high.
std::vector<double> flights(double g_level, double e, int n, double phase, int count) {
    const double contact = pi * std::sqrt(sphere_mass() / kStiffness);
    HandMadeBed w =
        plate(g_level, phase, 0, contact / 30, NormalForce::walton_braun_corrected, walton_braun_pair(e, 0));
    w.grains.add(0, 0, Vec3(0, 0, kRadius), kRadius, kDensity);
    w.grains.motion[0].velocity.z() = 0.5 * kGravity * n / kFrequency;
    w.start();
    std::vector<double> result;
    std::int64_t last = 0;
    bool touched = true;
    while (static_cast<int>(result.size()) < count && w.step < 4 * count * w.plan.clock.steps_per_period) {
        w.run(1);
        const bool touches = w.grains.load[0].force.z() > 0;
        if (touches && !touched) {
            result.push_back(static_cast<double>(w.step - last) /
                             static_cast<double>(w.plan.clock.steps_per_period));
            last = w.step;
        }
        touched = touches;
    }
    return result;
}

// Gamma cos(phase) = n pi (1 - e) / (1 + e), where phase is that of the touch.
double threshold(int n, double e) {
    return n * pi * (1 - e) / (1 + e);
}
double orbit_phase(double g_level, double e, int n) {
    return std::acos(std::min(1.0, threshold(n, e) / g_level)) / (2 * pi);
}

TEST(SinePlate, KeepsAnOrbitOfNPeriodsAboveItsThresholdOnly) {
    const double e = 0.5;
    for (const int n : {1, 2}) {
        const double above = 1.04 * threshold(n, e), below = 0.97 * threshold(n, e);
        const std::vector<double> kept = flights(above, e, n, orbit_phase(above, e, n), 25);
        ASSERT_EQ(kept.size(), 25u);
        for (std::size_t k = 15; k < kept.size(); ++k) EXPECT_NEAR(kept[k], n, 1e-3) << n;
        const std::vector<double> lost = flights(below, e, n, orbit_phase(below, e, n), 25);
        double farthest = 0;
        for (const double flight : lost) farthest = std::max(farthest, std::abs(flight - n));
        EXPECT_TRUE(lost.size() < 25 || farthest > 0.3) << n;
    }
}

// Beyond Gamma^2 = [n pi (1 - e) / (1 + e)]^2 + [2 (1 + e^2) / (1 + e)^2]^2, long and short flights
// alternate.
TEST(SinePlate, PeriodDoublesWhereTheClosedFormSays) {
    for (const double e : {0.5, 0.8}) {
        const double doubling = std::hypot(threshold(1, e), 2 * (1 + e * e) / std::pow(1 + e, 2));
        for (const double share : {0.98, 1.02}) {
            const double g_level = share * doubling;
            const std::vector<double> f = flights(g_level, e, 1, orbit_phase(g_level, e, 1) + 0.01, 80);
            ASSERT_EQ(f.size(), 80u);
            const double alternates = std::abs(f[79] - f[78]), repeats = std::abs(f[79] - f[77]);
            std::printf(
                "[ measured ] e %.1f, %.2f of the doubling: flights differ by %.4f, over two by %.4f\n", e,
                share, alternates, repeats);
            if (share < 1) {
                EXPECT_LT(alternates, 0.01);
            } else {
                EXPECT_GT(alternates, 0.05);
                EXPECT_LT(repeats, 0.02);
            }
        }
    }
}

}  // namespace
}  // namespace grainreel
