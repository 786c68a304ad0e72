// Tests of closed forms of all laws except Walton and Braun's: dashpots without attraction, Hertz and
// Mindlin, tables of restitution, rolling resistance; and of kinds of contact with laws of their own.
#include <gtest/gtest.h>

#include "engine/plan/damping.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

// Two equal spheres that meet head-on at speed v.
struct Rebound {
    double restitution, contact_time, largest_overlap, largest_force;
};
Rebound rebound(const PairPlan& pair, NormalForce law, double v, double step) {
    HandMadeBed w = make_world(pair, step, law, TangentialLaw::none);
    const double apart = kRadius + 0.25 * v * step;
    w.grains.add(0, 0, Vec3(-apart, 0, 0), kRadius, kDensity);
    w.grains.add(1, 0, Vec3(apart, 0, 0), kRadius, kDensity);
    w.grains.motion[0].velocity = Vec3(v / 2, 0, 0);
    w.grains.motion[1].velocity = Vec3(-v / 2, 0, 0);
    w.start();
    Rebound result{0, 0, 0, 0};
    for (std::int64_t touching = 0; touching == 0 || w.position(1).x() - w.position(0).x() < 2 * kRadius;) {
        w.run(1);
        const double overlap = 2 * kRadius - (w.position(1).x() - w.position(0).x());
        touching += overlap > 0;
        result.largest_overlap = std::max(result.largest_overlap, overlap);
        result.largest_force = std::max(result.largest_force, w.grains.load[0].force.norm());
        result.contact_time = static_cast<double>(touching) * step;
    }
    result.restitution = (w.velocity(1) - w.velocity(0)).x() / v;
    return result;
}

// Schwager & Poeschel 2007 give the restitution for a nominal damping if the dashpot must not pull.
TEST(Dashpot, WithoutAttractionReboundsFaster) {
    struct Row {
        double nominal, clipped;
    };
    for (const Row& row : {Row{0.9, 0.902}, Row{0.5, 0.550}, Row{0.1, 0.253}}) {
        const double beta = linear_damping(row.nominal, true);
        EXPECT_NEAR(linear_restitution(beta, false), row.clipped, 6e-4) << row.nominal;
        PairPlan pair = walton_braun_pair(1, 0);
        const double natural = std::sqrt(kStiffness / (sphere_mass() / 2));
        pair.normal_damping = 2 * natural * beta;
        const double step = pi / natural / 20000;
        EXPECT_NEAR(rebound(pair, NormalForce::spring_dashpot, 0.3, step).restitution, row.clipped, 1e-3);
        pair.attraction = true;
        EXPECT_NEAR(rebound(pair, NormalForce::spring_dashpot, 0.3, step).restitution, row.nominal, 1e-3);
    }
}

TEST(Dashpot, DampingAndRestitutionAreInverse) {
    for (const double e : {0.02, 0.1, 0.135, 0.4, 0.9, 0.999, 1.0}) {
        for (const bool attraction : {false, true}) {
            EXPECT_NEAR(linear_restitution(linear_damping(e, attraction), attraction), e, 1e-6) << e;
            if (e < 0.1) continue;
            EXPECT_NEAR(hertz_restitution(hertz_damping(e, attraction), attraction), e, 1e-5) << e;
        }
    }
    // The branches above and below critical damping meet there: e^-2 at beta = 1.
    EXPECT_NEAR(linear_restitution(1 - 1e-5, false), std::exp(-2), 1e-4);
    EXPECT_NEAR(linear_restitution(1 + 1e-5, false), std::exp(-2), 1e-4);
}

// A ball that falls from h0 on a floor: from touch on, with b the damping ratio, u = sqrt(2 g (h0 - r)),
//   y = [(g/w0^2) cos wt + ((b g/w0 - u) / w) sin wt] e^(-b w0 t) + r - g/w0^2,   w = w0 sqrt(1 - b^2).
TEST(Dashpot, FallingBallFollowsTheDampedOscillation) {
    const double natural = std::sqrt(kStiffness / sphere_mass()), beta = 0.1, gravity = 500,
                 height = 2 * kRadius;
    const double u = std::sqrt(2 * gravity * (height - kRadius)), fall = u / gravity;
    const double slower = natural * std::sqrt(1 - beta * beta), sink = gravity / (natural * natural);
    PairPlan pair = walton_braun_pair(1, 0);
    pair.normal_damping = 2 * natural * beta;
    HandMadeBed w = make_world(pair, fall / 20000, NormalForce::spring_dashpot, TangentialLaw::none);
    w.around.faces = {floor_face()};
    w.around.gravity = {0, 0, -gravity};
    w.grains.add(0, 0, Vec3(0, 0, height), kRadius, kDensity);
    w.start();
    w.run(20000);
    while (static_cast<double>(w.step) * w.plan.clock.step < fall + 0.8 * pi / slower) {
        const double t = static_cast<double>(w.step) * w.plan.clock.step - fall;
        const double swing =
            sink * std::cos(slower * t) + (beta * gravity / natural - u) / slower * std::sin(slower * t);
        const double expected = swing * std::exp(-beta * natural * t) + kRadius - sink;
        ASSERT_NEAR(w.position(0).z(), expected, 1e-3 * u / natural) << t;
        w.run(1);
    }
}

// A ball on the floor is pushed off its equilibrium and always in contact: u/w e^(-b w0 t) sin w t. The
// dashpot acts at the time of the force, so the error falls with the square of the step.
TEST(Dashpot, IsOfSecondOrderInTheStep) {
    const double natural = std::sqrt(kStiffness / sphere_mass()), beta = 0.2, push = 1e-4;
    const double sink = 10 * push / natural, gravity = sink * kStiffness / sphere_mass();
    const double slower = natural * std::sqrt(1 - beta * beta), period = 2 * pi / slower;
    const auto error = [&](int steps) {
        PairPlan pair = walton_braun_pair(1, 0);
        pair.normal_damping = 2 * natural * beta;
        HandMadeBed w = make_world(pair, period / steps, NormalForce::spring_dashpot, TangentialLaw::none);
        w.around.faces = {floor_face()};
        w.around.gravity = {0, 0, -gravity};
        w.grains.add(0, 0, Vec3(0, 0, kRadius - sink), kRadius, kDensity);
        w.grains.motion[0].velocity.z() = push;
        w.start();
        double largest = 0;
        for (int n = 1; n <= steps; ++n) {
            w.run(1);
            const double t = n * w.plan.clock.step;
            const double exact = push / slower * std::exp(-beta * natural * t) * std::sin(slower * t);
            largest = std::max(largest, std::abs(w.position(0).z() - kRadius + sink - exact));
        }
        return largest;
    };
    EXPECT_NEAR(error(100) / error(200), 4, 0.4);
    EXPECT_LT(error(200), 1e-3 * push / natural);
}

PairPlan hertz_pair(double e, double friction, bool attraction) {
    PairPlan pair;
    pair.modulus = 1e8;
    pair.restitution = e;
    pair.hertz_damping = hertz_damping(e, attraction);
    pair.attraction = attraction;
    pair.friction = friction;
    pair.tangential_ratio = 2 * (1 - 0.3) / (2 - 0.3);
    return pair;
}
// N/m^1.5, for two equal spheres
const double kHertz = 4.0 / 3 * 1e8 * std::sqrt(kRadius / 2);

// An elastic impact has a = (5 m v^2 / 4k)^0.4, P = k a^1.5, t = 2.9432 a / v (Timoshenko & Goodier art.
// 142).
TEST(Hertz, PeakAndDurationOfAnElasticImpact) {
    for (const double v : {0.03, 1.0}) {
        const double deepest = std::pow(1.25 * sphere_mass() / 2 * v * v / kHertz, 0.4);
        const double time = 2.9432 * deepest / v, step = time / 4000;
        const Rebound impact = rebound(hertz_pair(1, 0, false), NormalForce::hertz, v, step);
        EXPECT_NEAR(impact.largest_overlap, deepest, 1e-4 * deepest);
        EXPECT_NEAR(impact.largest_force, kHertz * std::pow(deepest, 1.5),
                    2e-4 * kHertz * std::pow(deepest, 1.5));
        EXPECT_NEAR(impact.contact_time, time, 1e-3 * time);
        EXPECT_NEAR(impact.restitution, 1, 1e-5);
    }
}

TEST(Hertz, RestitutionIsTheAskedOneAtAnySpeed) {
    for (const double e : {0.3, 0.7, 0.95}) {
        for (const bool attraction : {false, true}) {
            for (const double v : {0.03, 1.0}) {
                const double deepest = std::pow(1.25 * sphere_mass() / 2 * v * v / kHertz, 0.4);
                const double step = 2.9432 * deepest / v / 4000;
                EXPECT_NEAR(rebound(hertz_pair(e, 0, attraction), NormalForce::hertz, v, step).restitution, e,
                            1e-3)
                    << "attraction " << attraction << ", " << v << " m/s";
            }
        }
    }
}

// A ball is pressed on the floor and moved aside by s: T = K_t s with K_t = ratio 2 E* sqrt(R a).
TEST(Mindlin, StiffnessFollowsTheContactRadius) {
    PairPlan pair = hertz_pair(1, 10, false);
    HandMadeBed w = make_world(pair, 1e-9, NormalForce::hertz, TangentialLaw::mindlin);
    w.around.faces = {floor_face()};
    const double overlap = 1e-5, v = 1e-3;
    w.grains.add(0, 0, Vec3(0, 0, kRadius - overlap), kRadius, kDensity);
    w.grains.motion[0].velocity = Vec3(v, 0, 0);
    w.start();
    w.run(10);
    const double slip = v * 10 * w.plan.clock.step;
    const double expected = pair.tangential_ratio * 2e8 * std::sqrt(kRadius * overlap) * slip;
    Vec3 force = Vec3::Zero();
    w.loop->visit_contacts(w.step, [&](const ContactView& c) { force = c.tangential; });
    EXPECT_NEAR(force.x(), expected, 1e-3 * expected);
}

// If the contact slides throughout, the tangential impulse is mu times the normal one, whatever the law.
TEST(Mindlin, SlidingContactTakesCoulombsShare) {
    const double mu = 0.1, vn = 0.05, vt = 20 * mu * vn, e = 0.8;
    const double k = 4.0 / 3 * 1e8 * std::sqrt(kRadius);
    const double time = 2.9432 * std::pow(1.25 * sphere_mass() * vn * vn / k, 0.4) / vn;
    HandMadeBed w =
        make_world(hertz_pair(e, mu, false), time / 2000, NormalForce::hertz, TangentialLaw::mindlin);
    w.around.faces = {floor_face()};
    w.grains.add(0, 0, Vec3(0, 0, kRadius + 1e-9), kRadius, kDensity);
    w.grains.motion[0].velocity = Vec3(vt, 0, -vn);
    w.start();
    w.run(4000);
    EXPECT_NEAR(w.velocity(0).z(), e * vn, 2e-3 * vn);
    EXPECT_NEAR(vt - w.velocity(0).x(), mu * (1 + e) * vn, 5e-3 * mu * (1 + e) * vn);
}

// The contact is loaded with slip and then unloaded without it. The force shrinks with the contact's radius,
// so the stored energy T^2 / (2 K_t) falls; a force that kept its size would give energy without work.
TEST(Mindlin, UnloadingTheContactMakesNoEnergy) {
    HandMadeBed w = make_world(hertz_pair(1, 10, false), 1e-8, NormalForce::hertz, TangentialLaw::mindlin);
    w.around.faces = {floor_face()};
    w.grains.add(0, 0, Vec3(0, 0, kRadius - 1e-9), kRadius, kDensity);
    w.grains.motion[0].velocity = Vec3(0.02, 0, -0.05);
    w.start();
    const double start = w.energy();
    double highest = start;
    while (w.grains.load[0].force.z() > 0 || w.step < 10) {
        w.run(1);
        highest = std::max(highest, w.energy());
    }
    EXPECT_LT(highest, start * (1 + 1e-4));
}

TEST(RestitutionTable, HoldsAtItsRowsAndBetweenThem) {
    PairPlan pair = walton_braun_pair(0.9, 0);
    pair.restitution_table = {{0.05, 0.95}, {0.5, 0.8}, {2.0, 0.6}};
    const double effective = sphere_mass() / 2;
    struct Row {
        double v, e;
    };
    for (const Row& row : {Row{0.01, 0.95}, Row{0.05, 0.95}, Row{0.275, 0.875}, Row{0.5, 0.8}, Row{1.25, 0.7},
                           Row{2.0, 0.6}, Row{6.0, 0.6}}) {
        const double step = pi / 2 * (1 + row.e) * std::sqrt(effective / kStiffness) / 4000;
        EXPECT_NEAR(rebound(pair, NormalForce::walton_braun_table, row.v, step).restitution, row.e, 4e-4)
            << row.v;
    }
}

// Three kinds of pair with a restitution and a law each, and a wall with another law, are in one world.
TEST(KindsOfContact, EachHasItsLawAndItsNumbers) {
    const double v = 0.2, natural = std::sqrt(kStiffness / (sphere_mass() / 2));
    PairPlan one = walton_braun_pair(0.9, 0.3), mixed = walton_braun_pair(0.6, 0);
    PairPlan two = walton_braun_pair(0.75, 0), wall = walton_braun_pair(0.4, 0);
    mixed.model = {NormalForce::walton_braun, TangentialLaw::none, false};
    two.model = {NormalForce::spring_dashpot, TangentialLaw::none, false};
    two.normal_damping = 2 * natural * linear_damping(0.75, false);
    wall.model = mixed.model;
    HandMadeBed w = make_world(one, 5e-8);
    w.plan.grain = {one, mixed, mixed, two};
    w.plan.wall = {wall, wall};
    w.around.faces = {floor_face()};
    w.around.faces[0].point.z() = -10 * kRadius;
    const int species[4][2] = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
    for (int k = 0; k < 4; ++k) {
        for (const int side : {0, 1}) {
            w.grains.add(2 * k + side, species[k][side],
                         Vec3((side - 0.5) * 2.02 * kRadius, 10 * kRadius * k, 0), kRadius, kDensity);
            w.grains.motion.back().velocity = Vec3((0.5 - side) * v, 0, 0);
        }
    }
    w.grains.add(8, 1, Vec3(0, -10 * kRadius, -8.98 * kRadius), kRadius, kDensity);
    w.grains.motion.back().velocity = Vec3(0, 0, -v);
    w.start();
    w.run(20000);
    const double expected[4] = {0.9, 0.6, 0.6, 0.75};
    for (int k = 0; k < 4; ++k)
        EXPECT_NEAR((w.velocity(2 * k + 1) - w.velocity(2 * k)).x() / v, expected[k], 2e-3) << k;
    EXPECT_NEAR(w.velocity(8).z() / v, 0.4, 2e-3);
}

// Species whose contacts do not differ share one row of parameters, and observers must read that row too.
// Pairs of two kinds, computed before walls of one kind, must not lend these their kind.
TEST(KindsOfContact, OfPairsDoNotShowAtWalls) {
    const auto rolled = [](bool with_pairs) {
        PairPlan pair = walton_braun_pair(0.8, 0.5);
        pair.model.rolls = true;
        pair.rolling_friction = 0.05;
        HandMadeBed w = make_world(pair, 2e-6);
        w.plan.grain.assign(4, w.plan.grain[0]);
        w.plan.grain[3].rolling_friction = 0.4;
        w.plan.wall.assign(2, w.plan.wall[0]);
        w.around.faces = {floor_face()};
        w.around.gravity = {0, 0, -9.81};
        w.grains.add(0, 1, Vec3(0, 0, kRadius), kRadius, kDensity);
        w.grains.motion.back().velocity.x() = 0.1;
        for (int k = 0; with_pairs && k < 6; ++k)
            w.grains.add(1 + k, 1, Vec3(1.999 * kRadius * k, 20 * kRadius, kRadius), kRadius, kDensity);
        w.start();
        w.run(3000);
        return w.spin(0);
    };
    EXPECT_GT(rolled(false).norm(), 1);
    EXPECT_EQ(rolled(false), rolled(true));
}

TEST(KindsOfContact, EqualOnesAreOneForObserversToo) {
    PairPlan pair = walton_braun_pair(1, 0);
    HandMadeBed w = make_world(pair, 1e-9, NormalForce::spring_dashpot, TangentialLaw::none);
    w.plan.grain.assign(4, w.plan.grain[0]);
    w.plan.wall.assign(2, w.plan.wall[0]);
    const double overlap = 1e-5;
    w.grains.add(0, 1, Vec3(0, 0, 0), kRadius, kDensity);
    w.grains.add(1, 1, Vec3(2 * kRadius - overlap, 0, 0), kRadius, kDensity);
    w.start();
    const double stored = 0.5 * kStiffness * overlap * overlap;
    EXPECT_NEAR(w.energy(), stored, of_rounding(1e-9, 1e-7) * stored);
}

// Rolling without slip against M = mu_r R N: m a = -F and I a / r = F r - M give a = -(5/7) mu_r g.
TEST(Rolling, SlowsABallDown) {
    const double rolling = 0.02, gravity = 9.81, u = 0.2;
    PairPlan pair = walton_braun_pair(0.9, 0.8);
    pair.model.rolls = true;
    pair.rolling_friction = rolling;
    HandMadeBed w = make_world(pair, 1e-6);
    w.around.faces = {floor_face()};
    w.around.gravity = {0, 0, -gravity};
    const double arm = kRadius - sphere_mass() * gravity / kStiffness;
    w.grains.add(0, 0, Vec3(0, 0, arm), kRadius, kDensity);
    w.grains.motion[0].velocity = Vec3(u, 0, 0);
    w.grains.motion[0].spin = Vec3(0, u / arm, 0);
    w.start();
    w.run(500000);
    EXPECT_NEAR(w.velocity(0).x(), u - 5.0 / 7 * rolling * gravity * 0.5, 2e-3 * u);
}

// On a slope rolling friction holds a ball as long as tan < mu_r. Beyond that the ball rolls with (5/7) g
// (sin - mu_r cos).
TEST(Rolling, HoldsABallOnASlopeUpToItsFriction) {
    const double rolling = 0.1, gravity = 9.81;
    for (const double slope : {0.8 * rolling, 2 * rolling}) {
        const double angle = std::atan(slope);
        PairPlan pair = walton_braun_pair(0.9, 0.8);
        pair.model = {NormalForce::spring_dashpot, TangentialLaw::linear_spring, true};
        pair.normal_damping = 0.4 * std::sqrt(kStiffness / sphere_mass());
        pair.tangential_damping = pair.normal_damping;
        pair.rolling_friction = rolling;
        HandMadeBed w = make_world(pair, 1e-6, NormalForce::spring_dashpot, TangentialLaw::linear_spring);
        w.around.faces = {floor_face()};
        w.around.gravity = gravity * Vec3(std::sin(angle), 0, -std::cos(angle));
        w.grains.add(0, 0, Vec3(0, 0, kRadius - sphere_mass() * gravity / kStiffness), kRadius, kDensity);
        w.start();
        w.run(300000);
        const double time = 0.3;
        const double a = 5.0 / 7 * gravity * (std::sin(angle) - rolling * std::cos(angle));
        EXPECT_NEAR(w.velocity(0).x(), a > 0 ? a * time : 0, 0.01 * gravity * angle * time) << slope;
    }
}

// Two spheres roll on each other: the torques on them are opposite, and angular momentum is kept.
TEST(Rolling, KeepsAngularMomentumBetweenGrains) {
    PairPlan pair = walton_braun_pair(0.7, 0.4);
    pair.model.rolls = true;
    pair.rolling_friction = 0.3;
    HandMadeBed w = make_world(pair, 1e-7);
    w.grains.add(0, 0, Vec3(-kRadius, 0, 0), kRadius, kDensity);
    w.grains.add(1, 0, Vec3(0.52 * kRadius, 0, 0), 0.5 * kRadius, kDensity);
    w.grains.motion[0].velocity = Vec3(0.4, 0, 0);
    w.grains.motion[0].spin = Vec3(5, 80, -60);
    w.start();
    const auto angular = [&] {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < w.grains.size(); ++i)
            sum += w.grains.mass(i) * w.grains.place[i].position.cross(w.grains.motion[i].velocity) +
                   w.grains.inertia(i) * w.grains.motion[i].spin;
        return sum;
    };
    const Vec3 before = angular();
    w.run(8000);
    ASSERT_GT((w.spin(1)).norm(), 1) << "they never met";
    EXPECT_LT((angular() - before).norm(), of_rounding(1e-11, 1e-8) * before.norm());
}

// Along the unloading branch of Walton and Braun nothing is lost: kinetic and stored energy add up to the
// share e^2 of the energy that came in, all the way.
TEST(StoredEnergy, IsWhatUnloadingGivesBack) {
    const double e = 0.6, v = 0.3;
    HandMadeBed w = make_world(walton_braun_pair(e, 0), 1e-8);
    w.grains.add(0, 0, Vec3(-kRadius, 0, 0), kRadius, kDensity);
    w.grains.add(1, 0, Vec3(kRadius, 0, 0), kRadius, kDensity);
    w.grains.motion[0].velocity = Vec3(v, 0, 0);
    w.start();
    const double centre = 0.25 * sphere_mass() * v * v;  // J; the kinetic energy of the centre of mass stays
    int looked = 0;
    while (w.grains.load[0].force.x() != 0 || w.step < 10) {
        w.run(1);
        if (w.velocity(0).x() > w.velocity(1).x()) continue;
        EXPECT_NEAR((w.energy() - centre) / centre, e * e, 1e-3);
        ++looked;
    }
    EXPECT_GT(looked, 100);
}

}  // namespace
}  // namespace grainreel
