// Tests of closed forms of single impacts.
#include <gtest/gtest.h>

#include "engine/laws/walton_braun-inl.hpp"
#include "engine/plan/damping.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

// Two equal spheres that approach head-on at speed v, with a gap (m) between them. t: s from touch to
// separation.
struct Impact {
    double e, contact_time, largest_overlap, lost;
};

Impact head_on(const PairPlan& pair, double v, double step, double gap,
               NormalForce law = NormalForce::walton_braun) {
    HandMadeBed w = make_world(pair, step, law, TangentialLaw::none);
    w.grains.add(0, 0, Vec3(-kRadius - gap / 2, 0, 0), kRadius, kDensity);
    w.grains.add(1, 0, Vec3(kRadius + gap / 2, 0, 0), kRadius, kDensity);
    w.grains.motion[0].velocity = Vec3(v / 2, 0, 0);
    w.grains.motion[1].velocity = Vec3(-v / 2, 0, 0);
    w.start();
    const double before = kinetic_energy(w.grains).translation;
    Impact impact{0, 0, 0, 0};
    std::int64_t touching = 0;
    for (bool met = false;;) {
        w.run(1);
        const double overlap = 2 * kRadius - (w.position(1) - w.position(0)).norm();
        impact.largest_overlap = std::max(impact.largest_overlap, overlap);
        // The force ends at the residual overlap, before the spheres part.
        const bool pushes = w.grains.load[0].force.squaredNorm() > 0;
        touching += pushes;
        if (met && !pushes) break;
        met = met || pushes;
    }
    impact.contact_time = static_cast<double>(touching) * step;
    impact.e = (w.velocity(1) - w.velocity(0)).x() / v;
    impact.lost = before - kinetic_energy(w.grains).translation;
    return impact;
}

TEST(NormalImpact, FollowsTheClosedFormsOfWaltonAndBraun) {
    const double effective = sphere_mass() / 2, v = 0.3;
    for (const double e : {0.3, 0.6, 0.9, 1.0}) {
        const double time = std::numbers::pi / 2 * (1 + e) * std::sqrt(effective / kStiffness);
        const double step = time / 4000;
        const Impact impact = head_on(walton_braun_pair(e, 0), v, step, 0.37 * v * step);
        EXPECT_NEAR(impact.e, e, 2e-4) << e;
        EXPECT_NEAR(impact.contact_time, time, 3 * step) << e;
        const double deepest = v * std::sqrt(effective / kStiffness);
        EXPECT_NEAR(impact.largest_overlap, deepest, 1e-3 * deepest) << e;
        EXPECT_NEAR(impact.lost, 0.5 * effective * v * v * (1 - e * e), 1e-3 * effective * v * v) << e;
    }
}

// docs/reference/accuracy.md: largest error of e over the phase of the first touch, plain velocity
// Verlet.
TEST(NormalImpact, RestitutionErrorOfCoarseStepsIsTheTableOfSectionSix) {
    struct Row {
        double e;
        int steps;
        double error;
    };
    for (const Row& row :
         {Row{0.9, 5, 0.019}, Row{0.9, 10, 0.0032}, Row{0.3, 10, 0.013}, Row{0.3, 20, 0.0014}}) {
        const double effective = sphere_mass() / 2, v = 0.3;
        const double time = std::numbers::pi / 2 * (1 + row.e) * std::sqrt(effective / kStiffness);
        const double step = time / row.steps;
        double largest = 0;
        for (int phase = 0; phase < 200; ++phase) {
            const Impact impact =
                head_on(walton_braun_pair(row.e, 0), v, step, (phase + 0.5) / 200 * v * step);
            largest = std::max(largest, std::abs(impact.e - row.e));
        }
        EXPECT_NEAR(largest, row.error, 0.08 * row.error) << row.e << " with " << row.steps << " steps";
    }
}

// Walton & Braun 1986: e(v) = sqrt(w0 / (w0 + S v)); contact time (pi/2)(1 + e) / w0.
TEST(NormalImpact, RestitutionFallsWithSpeedAsWaltonAndBraunHaveIt) {
    PairPlan pair = walton_braun_pair(0.9, 0);
    const double natural = std::sqrt(kStiffness / (sphere_mass() / 2));
    pair.hardening = 0.4 * natural;  // so that e = sqrt(1 / (1 + 0.4 s/m v))
    for (const double v : {0.02, 0.3, 2.0, 10.0}) {
        const double e = 1 / std::sqrt(1 + 0.4 * v), time = std::numbers::pi / 2 * (1 + e) / natural;
        const double step = time / 4000;
        const Impact impact = head_on(pair, v, step, 0.37 * v * step, NormalForce::walton_braun_speed);
        EXPECT_NEAR(impact.e, e, 2e-4) << v;
        EXPECT_NEAR(impact.contact_time, time, 3 * step) << v;
        EXPECT_NEAR(impact.lost, 0.25 * sphere_mass() * v * v * (1 - e * e), 1e-3 * sphere_mass() * v * v)
            << v;
    }
}

// Schwager & Poeschel 2007: a dashpot that may pull at the end gives e = exp(-pi b / sqrt(1 - b^2)) and the
// contact time pi / (w0 sqrt(1 - b^2)), where b = c / (2 w0).
TEST(NormalImpact, SpringAndDashpotReboundAsTheClosedFormSays) {
    const double natural = std::sqrt(kStiffness / (sphere_mass() / 2)), v = 0.3;
    for (const double damping_ratio : {0.03, 0.2, 0.5}) {
        PairPlan pair = walton_braun_pair(1, 0);
        pair.normal_damping = 2 * natural * damping_ratio;
        pair.attraction = true;
        const double slower = std::sqrt(1 - damping_ratio * damping_ratio);
        const double e = std::exp(-std::numbers::pi * damping_ratio / slower);
        const double time = std::numbers::pi / (natural * slower), step = time / 8000;
        const Impact impact = head_on(pair, v, step, 0.5 * v * step, NormalForce::spring_dashpot);
        EXPECT_NEAR(impact.e, e, 5e-4) << damping_ratio;
        EXPECT_NEAR(impact.contact_time, time, 3 * step) << damping_ratio;
    }
}

// Without hardening its contacts are those of the plain law, bit for bit except for how K2 (a - a0) is
// written.
TEST(NormalImpact, WithoutHardeningTheLawOfSpeedsIsThePlainOne) {
    const PairPlan pair = walton_braun_pair(0.7, 0);
    const double step = 2e-7, v = 0.5;
    const Impact plain = head_on(pair, v, step, 1e-9);
    const Impact other = head_on(pair, v, step, 1e-9, NormalForce::walton_braun_speed);
    EXPECT_NEAR(other.e, plain.e, of_rounding(1e-12, 3e-7));
    EXPECT_EQ(other.contact_time, plain.contact_time);
}

TEST(NormalImpact, EndsAtTheResidualOverlap) {
    const double e = 0.6, v = 0.3, effective = sphere_mass() / 2;
    const double deepest = v * std::sqrt(effective / kStiffness);
    const PairPlan pair = walton_braun_pair(e, 0);
    using namespace HWY_NAMESPACE;
    const WaltonBraun::Parameters<double> p = WaltonBraun::from(pair);
    WaltonBraun::History<double> h{};
    Touch<double> touch{};
    touch.overlap = deepest;
    EXPECT_DOUBLE_EQ(WaltonBraun::force(p, h, touch), kStiffness * deepest);
    const double residual = (1 - e * e) * deepest;
    touch.overlap = residual * 1.000001;
    EXPECT_GT(WaltonBraun::force(p, h, touch), 0);
    touch.overlap = residual * 0.999999;
    EXPECT_EQ(WaltonBraun::force(p, h, touch), 0);
    // Reloading from the gap goes up K2, not K1, until it meets K1 again; the residual did not shrink.
    touch.overlap = residual + 0.25 * (deepest - residual);
    EXPECT_NEAR(WaltonBraun::force(p, h, touch), kStiffness / (e * e) * (touch.overlap - residual), 1e-9);
    touch.overlap = 1.5 * deepest;
    EXPECT_DOUBLE_EQ(WaltonBraun::force(p, h, touch), kStiffness * 1.5 * deepest);
}

// A sphere hits the floor at an angle with infinite mu: v_t' = v_t cos[sqrt(3.5 K0/K1) (pi/2)(1 + e)].
TEST(ObliqueImpact, StickingContactTurnsTheSlipAsTheClosedFormSays) {
    for (const double e : {0.5, 0.9}) {
        for (const double ratio : {0.3, 0.8}) {
            HandMadeBed w = make_world(walton_braun_pair(e, INFINITY, ratio), 0);
            const double time = std::numbers::pi / 2 * (1 + e) * std::sqrt(sphere_mass() / kStiffness);
            w.plan.clock.step = time / 2000;
            w.around.faces = {floor_face()};
            const double vn = 0.05, vt = 0.05;
            w.grains.add(0, 0, Vec3(0, 0, kRadius + 0.4 * vn * w.plan.clock.step), kRadius, kDensity);
            w.grains.motion[0].velocity = Vec3(vt, 0, -vn);
            w.start();
            w.run(1);
            while (w.grains.load[0].force.z() > 0 || w.step < 100)
                w.run(1);  // up to the end of the normal force
            const double slip = w.velocity(0).x() - kRadius * w.spin(0).y();
            const double angle = std::sqrt(3.5 * ratio) * std::numbers::pi / 2 * (1 + e);
            EXPECT_NEAR(w.velocity(0).z(), e * vn, 2e-3 * vn);
            EXPECT_NEAR(slip, vt * std::cos(angle), 0.01 * vt) << e << " " << ratio;
        }
    }
}

// The same holds for two spheres head-on, if all of the slip comes from one that spins.
TEST(ObliqueImpact, SpinOfOneSphereIsSlipForBoth) {
    const double e = 0.8, ratio = 0.5, v = 0.05, vt = 0.05;
    HandMadeBed w = make_world(walton_braun_pair(e, INFINITY, ratio), 0);
    w.plan.clock.step = std::numbers::pi / 2 * (1 + e) * std::sqrt(sphere_mass() / 2 / kStiffness) / 2000;
    const double apart = kRadius + 0.2 * v * w.plan.clock.step;
    w.grains.add(0, 0, Vec3(-apart, 0, 0), kRadius, kDensity);
    w.grains.add(1, 0, Vec3(apart, 0, 0), kRadius, kDensity);
    w.grains.motion[0].velocity = Vec3(v / 2, 0, 0);
    w.grains.motion[1].velocity = Vec3(-v / 2, 0, 0);
    w.grains.motion[0].spin = Vec3(0, 0, vt / kRadius);
    w.start();
    w.run(1);
    while (std::abs(w.grains.load[0].force.x()) > 0 || w.step < 100) w.run(1);
    const double slip = w.velocity(0).y() - w.velocity(1).y() + kRadius * (w.spin(0).z() + w.spin(1).z());
    const double angle = std::sqrt(3.5 * ratio) * std::numbers::pi / 2 * (1 + e);
    EXPECT_NEAR(slip, vt * std::cos(angle), 0.01 * vt);
}

TEST(ObliqueImpact, SlidingContactTakesCoulombsShare) {
    const double e = 0.9, mu = 0.2, vn = 0.05, ratio = 0.8;
    const double vt = 1.5 * vn * mu * std::max({3.5, 1 / ratio, 3.5 * (1 + e) - 1 / (e * ratio)});
    HandMadeBed w = make_world(walton_braun_pair(e, mu, ratio), 0, NormalForce::walton_braun,
                               TangentialLaw::linear_spring);
    w.plan.clock.step = std::numbers::pi / 2 * (1 + e) * std::sqrt(sphere_mass() / kStiffness) / 2000;
    w.around.faces = {floor_face()};
    w.grains.add(0, 0, Vec3(0, 0, kRadius + 0.4 * vn * w.plan.clock.step), kRadius, kDensity);
    w.grains.motion[0].velocity = Vec3(vt, 0, -vn);
    w.start();
    w.run(4000);
    EXPECT_NEAR(vt - w.velocity(0).x(), mu * (1 + e) * vn, 5e-3 * mu * (1 + e) * vn);
    EXPECT_NEAR(w.spin(0).y(), 2.5 * mu * (1 + e) * vn / kRadius, 5e-3 * 2.5 * mu * (1 + e) * vn / kRadius);
}

// Two unequal spheres meet off-centre and spin. Linear and angular momentum are kept to round-off, with arms
// that reach to the contact plane.
TEST(ObliqueImpact, KeepsLinearAndAngularMomentum) {
    HandMadeBed w = make_world(walton_braun_pair(0.7, 0.4), 1e-7);
    w.grains.add(0, 0, Vec3(-1.01 * kRadius, 0.3 * kRadius, 0), kRadius, kDensity);
    w.grains.add(1, 0, Vec3(0.62 * kRadius, 0, 0.2 * kRadius), 0.6 * kRadius, kDensity);
    w.grains.motion[0].velocity = Vec3(0.4, 0, 0.1);
    w.grains.motion[1].velocity = Vec3(-0.2, 0.1, 0);
    w.grains.motion[0].spin = Vec3(20, -30, 50);
    w.start();
    const auto momenta = [&] {
        Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
        for (std::size_t i = 0; i < w.grains.size(); ++i) {
            const Vec3 p = w.grains.mass(i) * w.grains.motion[i].velocity;
            linear += p;
            angular += w.grains.place[i].position.cross(p) + w.grains.inertia(i) * w.grains.motion[i].spin;
        }
        return std::pair(linear, angular);
    };
    const auto [linear, angular] = momenta();
    w.run(8000);
    ASSERT_GT(w.loop->listed_pairs(), 0u);
    ASSERT_GT((w.velocity(0) - Vec3(0.4, 0, 0.1)).norm(), 0.01) << "they never met";
    const auto [linear_after, angular_after] = momenta();
    EXPECT_LT((linear_after - linear).norm(), 1e-13 * linear.norm());
    EXPECT_LT((angular_after - angular).norm(), of_rounding(1e-11, 1e-8) * angular.norm());
}

// A dashpot proportional to the root of the effective mass gives one restitution for grains of every size;
// one proportional to the mass does not.
TEST(NormalImpact, ADashpotByTheRootOfTheMassKeepsTheRestitutionOfAllSizes) {
    for (const double e : {0.3, 0.5, 0.8}) {
        PairPlan pair = walton_braun_pair(1, 0);
        pair.damping_by_root = 2 * std::sqrt(kStiffness) * linear_damping(e, false);
        for (const double one : {0.5, 1.0, 4.0}) {
            for (const double other : {0.5, 2.0, 0.0}) {  // 0: a wall
                const double first = sphere_mass(one * kRadius), second = sphere_mass(other * kRadius);
                const double mass = other > 0 ? first * second / (first + second) : first;
                const double v = 0.1, step = std::numbers::pi * std::sqrt(mass / kStiffness) / 1000;
                HandMadeBed w = make_world(pair, step, NormalForce::spring_dashpot, TangentialLaw::none);
                w.around.skin = 0.1 * kRadius;
                w.grains.add(0, 0, Vec3(0, 0, 1.0001 * one * kRadius), one * kRadius, kDensity);
                w.grains.motion[0].velocity = Vec3(0, 0, -v);
                if (other > 0)
                    w.grains.add(1, 0, Vec3(0, 0, -other * kRadius), other * kRadius, kDensity);
                else
                    w.around.faces = {floor_face()};
                w.start();
                w.run(2500);
                const double left = w.velocity(0).z() - (other > 0 ? w.velocity(1).z() : 0);
                EXPECT_NEAR(left / v, e, of_rounding(3e-3, 4e-3)) << one << " on " << other;
            }
        }
    }
}

}  // namespace
}  // namespace grainreel
