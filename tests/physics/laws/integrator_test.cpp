// Tests of the integrators: order on smooth motion, agreement with one another, and the corrections at the
// beginning and end of a contact.
#include <gtest/gtest.h>

#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

constexpr Integrator kAll[] = {Integrator::velocity_verlet, Integrator::leapfrog, Integrator::position_verlet,
                               Integrator::forest_ruth, Integrator::gear};

// A ball on the floor's elastic spring is pushed off its equilibrium and always in contact: (u/w) sin wt.
double swing_error(Integrator integrator, int steps) {
    PairPlan pair = walton_braun_pair(1, 0);
    const double natural = std::sqrt(kStiffness / sphere_mass()), push = 1e-4;
    const double sink = 10 * push / natural, period = 2 * pi / natural;
    HandMadeBed w = make_world(pair, period / steps, NormalForce::walton_braun, TangentialLaw::none);
    w.plan.integrator = integrator;
    w.around.faces = {floor_face()};
    w.around.gravity = {0, 0, -sink * kStiffness / sphere_mass()};
    w.grains.add(0, 0, Vec3(0, 0, kRadius - sink), kRadius, kDensity);
    w.grains.motion[0].velocity.z() = push;
    // Leapfrog's velocity is that of half a step before the start.
    if (integrator == Integrator::leapfrog)
        w.grains.motion[0].velocity.z() = push * std::cos(natural * 0.5 * w.plan.clock.step);
    w.start();
    double largest = 0;
    for (int n = 1; n <= 2 * steps; ++n) {
        w.run(1);
        const double exact = push / natural * std::sin(natural * n * w.plan.clock.step);
        largest = std::max(largest, std::abs(w.position(0).z() - kRadius + sink - exact));
    }
    return largest / (push / natural);
}

TEST(Integrators, HaveTheirOrderOnSmoothMotion) {
    for (const Integrator integrator : kAll) {
        const double ratio = swing_error(integrator, 50) / swing_error(integrator, 100);
        const int name = static_cast<int>(integrator);
        if (integrator == Integrator::forest_ruth) {
            // In floats the remaining error is already rounding.
            if (!mixed_precision()) {
                EXPECT_NEAR(std::log2(ratio), 4, 0.2);
            }
            EXPECT_LT(swing_error(integrator, 50), 1e-5);
        } else if (integrator == Integrator::gear) {
            EXPECT_NEAR(std::log2(ratio), 2, 0.1);
        } else {
            EXPECT_NEAR(std::log2(ratio), 2, 0.1) << name;
            EXPECT_NEAR(swing_error(integrator, 100), std::pow(2 * pi / 100, 2) / 24 * 4 * pi, 3e-3) << name;
        }
    }
}

// Lists know how far grains have moved since they were made, even if runs end after every step: two grains
// that fly towards each other meet when the gap between them is closed.
TEST(Integrators, MeetInTimeStepByStep) {
    constexpr double kSpeed = 2, kStep = 2e-6, kGap = 0.5 * kRadius;
    for (const Integrator integrator : kAll) {
        for (const double skin : {0.02 * kRadius, 0.2 * kRadius, 0.6 * kRadius}) {
            HandMadeBed w =
                make_world(walton_braun_pair(1, 0), kStep, NormalForce::walton_braun, TangentialLaw::none);
            w.plan.integrator = integrator;
            w.around.skin = skin;
            w.grains.add(0, 0, Vec3(0, 0, 0), kRadius, kDensity);
            w.grains.add(1, 0, Vec3(2 * kRadius + kGap, 0, 0), kRadius, kDensity);
            w.grains.motion[0].velocity.x() = kSpeed / 2;
            w.grains.motion[1].velocity.x() = -kSpeed / 2;
            w.start();
            int steps = 0;
            while (w.velocity(0).x() >= kSpeed / 2 * (1 - 1e-9) && steps < 10'000) w.run(1), ++steps;
            EXPECT_NEAR(steps, kGap / kSpeed / kStep, 3) << static_cast<int>(integrator) << ' ' << skin;
        }
    }
}

// A run in pieces is the same as a run in one go: nothing that a step leaves to the next is lost between
// them.
TEST(Integrators, GoOnWhereTheyStopped) {
    for (const Integrator integrator : kAll) {
        const auto end = [&](int pieces) {
            HandMadeBed w = make_world(walton_braun_pair(0.8, 0.4), 2e-6);
            w.plan.integrator = integrator;
            w.around.faces = {floor_face()};
            w.around.gravity = {0, 0, -9.81};
            w.grains.add(0, 0, Vec3(0, 0, 1.01 * kRadius), kRadius, kDensity);
            w.grains.add(1, 0, Vec3(0.3 * kRadius, 0, 3.05 * kRadius), kRadius, kDensity);
            w.grains.motion[1].velocity = Vec3(0.1, 0.02, -0.5);
            w.grains.motion[0].spin = Vec3(30, 0, 10);
            w.start();
            for (int k = 0; k < pieces; ++k) w.run(3000 / pieces);
            return std::vector<double>{w.position(0).x(), w.position(1).y(), w.velocity(1).z(),
                                       w.spin(0).x()};
        };
        const std::vector<double> whole = end(1), cut = end(60);
        for (std::size_t k = 0; k < whole.size(); ++k)
            EXPECT_EQ(cut[k], whole[k]) << static_cast<int>(integrator);
    }
}

// All integrators come to the same collision as the step shrinks, except one whose drift goes backwards at
// times: friction with a memory takes that for a turn of the slip, however short the step. The plan warns of
// it.
TEST(Integrators, AgreeOnAnObliqueImpact) {
    std::vector<Vec3> velocities;
    for (const Integrator integrator : kAll) {
        HandMadeBed w = make_world(walton_braun_pair(0.8, 0.3), 2e-8);
        w.plan.integrator = integrator;
        w.around.faces = {floor_face()};
        w.grains.add(0, 0, Vec3(0, 0, kRadius + 1e-7), kRadius, kDensity);
        w.grains.motion[0].velocity = Vec3(0.1, 0, -0.2);
        w.start();
        w.run(10000);
        velocities.push_back(w.velocity(0));
    }
    for (const Vec3& v : velocities) {
        EXPECT_NEAR(v.z(), 0.8 * 0.2, 2e-4);
        if (&v - velocities.data() == static_cast<std::ptrdiff_t>(Integrator::forest_ruth)) {
            EXPECT_GT(std::abs(v.x() - velocities[0].x()), 2e-3);
        } else {
            EXPECT_NEAR(v.x(), velocities[0].x(), 2e-4);
        }
    }
}

double largest_restitution_error(double e, int steps, NormalForce law, Integrator integrator) {
    const double effective = sphere_mass() / 2, v = 0.3;
    const double step = pi / 2 * (1 + e) * std::sqrt(effective / kStiffness) / steps;
    double largest = 0;
    for (int phase = 0; phase < 200; ++phase) {
        HandMadeBed w = make_world(walton_braun_pair(e, 0), step, law, TangentialLaw::none);
        w.plan.integrator = integrator;
        const double apart = kRadius + 0.5 * (phase + 0.5) / 200 * v * step;
        w.grains.add(0, 0, Vec3(-apart, 0, 0), kRadius, kDensity);
        w.grains.add(1, 0, Vec3(apart, 0, 0), kRadius, kDensity);
        w.grains.motion[0].velocity = Vec3(v / 2, 0, 0);
        w.grains.motion[1].velocity = Vec3(-v / 2, 0, 0);
        w.start();
        w.run(3 * steps);
        largest = std::max(largest, std::abs((w.velocity(1) - w.velocity(0)).x() / v - e));
    }
    return largest;
}

// Plain Verlet has .0018, .0050, .0076, .0082 at 12 steps (docs/reference/accuracy.md).
TEST(Corrections, BringTheRestitutionBackAtTwelveSteps) {
    struct Row {
        double e, plain, bound;
    };
    for (const Row& row : {Row{0.9, 0.0018, 0.002}, Row{0.7, 0.0050, 0.002}, Row{0.5, 0.0076, 0.005},
                           Row{0.3, 0.0082, 0.005}}) {
        const Integrator verlet = Integrator::velocity_verlet;
        EXPECT_NEAR(largest_restitution_error(row.e, 12, NormalForce::walton_braun, verlet), row.plain,
                    0.08 * row.plain);
        const double corrected =
            largest_restitution_error(row.e, 12, NormalForce::walton_braun_corrected, verlet);
        EXPECT_LT(corrected, row.bound) << row.e;
        EXPECT_LT(corrected, row.plain) << row.e;
    }
}

TEST(Corrections, VanishWithTheStep) {
    for (const double e : {0.5, 0.9, 1.0})
        EXPECT_LT(largest_restitution_error(e, 400, NormalForce::walton_braun_corrected,
                                            Integrator::velocity_verlet),
                  1e-4);
}

}  // namespace
}  // namespace grainreel
