// Tests of the fast step against the plain one of reference_step.hpp, which looks at all pairs: each law over
// a bed that settles, one that is shaken and one that flies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/physics/step/reference_step.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

struct Laws {
    const char* name;
    NormalForce normal;
    TangentialLaw tangential;
    bool rolls = false, attraction = false;
};

constexpr double kStep = 4e-6;               // s, some 25 to a contact
constexpr double kSizes[] = {2e-3, 1.4e-3};  // m, of the species

double mass_of(int species) {
    return sphere_mass(kSizes[species]);
}

// Contacts of two species, or of one species and the wall, with numbers that differ from kind to kind.
PairPlan pair_of(const Laws& laws, int kind) {
    PairPlan p = walton_braun_pair(0.6 + 0.1 * kind, 0.2 + 0.15 * kind);
    for (double* stiffness : {&p.loading_stiffness, &p.unloading_stiffness, &p.tangential_stiffness})
        *stiffness *= 0.2;
    p.model = {laws.normal, laws.tangential, laws.rolls, Precision::full, nullptr};
    p.rolling_friction = laws.rolls ? 0.05 + 0.05 * kind : 0;
    p.attraction = laws.attraction;
    p.hardening = laws.normal == NormalForce::walton_braun_speed ? 2e4 : 0;
    if (laws.normal == NormalForce::walton_braun_table)
        p.restitution_table = {{0.1, 0.9}, {0.4, 0.7}, {2, 0.4}};
    if (laws.normal == NormalForce::walton_braun_speed) p.unloading_stiffness = p.loading_stiffness;
    p.normal_damping = 8e3;
    p.tangential_damping = 3e3;
    p.modulus = 4e7;
    p.hertz_damping = 0.3;
    if (laws.normal == NormalForce::hertz) p.tangential_ratio = 0.82;
    return p;
}

struct Bed {
    std::string name;
    Vec3 gravity, thrown;  // m/s2; m/s, on top of random velocities
    Container::Shape shape;
    ReferenceShaking shaking;
    int steps;
};

std::vector<Face> faces_of(const Bed& bed) {
    Container c;
    c.shape = bed.shape;
    c.depth = 0.016;
    c.half_width = bed.shape == Container::Shape::cylinder ? 0.009 : 0.008;
    c.half_angle = 0.4;
    c.slant_height = 0.008;
    c.height = 0.03;
    Drive drive;
    drive.present = true;
    return container_faces(c, drive);
}

// A loose lattice of both species above the floor, with random velocities and spins.
std::vector<ReferenceGrain> grains_of(const Bed& bed) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto vector = [&](double size) {
        return Vec3(size * any(random), size * any(random), size * any(random));
    };
    std::vector<ReferenceGrain> grains;
    for (int n = 0; n < 36; ++n) {
        ReferenceGrain g;
        g.species = n % 2;
        g.radius = kSizes[g.species];
        g.mass = mass_of(g.species);
        g.position = 0.0042 * Vec3(n % 3 - 1, n / 3 % 3 - 1, 1.5 + n / 9) + vector(0.2e-3);
        g.velocity = bed.thrown + vector(0.4);
        g.spin = vector(100);
        grains.push_back(g);
    }
    return grains;
}

HandMadeBed fast_world(const Plan& plan, const Bed& bed, const std::vector<ReferenceGrain>& grains) {
    HandMadeBed w;
    w.plan = plan;
    w.around.faces = faces_of(bed);
    w.around.gravity = bed.gravity;
    Drive drive;
    drive.present = bed.shaking.amplitude > 0;
    drive.frequency = bed.shaking.frequency;
    drive.amplitude = bed.shaking.amplitude;
    drive.direction = bed.shaking.direction;
    drive.ramp = 0;
    w.around.motion = DriveMotion(drive, plan.clock);
    for (std::size_t i = 0; i < grains.size(); ++i) {
        w.grains.add(static_cast<std::int32_t>(i), grains[i].species, grains[i].position, grains[i].radius,
                     kDensity);
        w.grains.motion[i].velocity = grains[i].velocity;
        w.grains.motion[i].spin = grains[i].spin;
    }
    w.start();
    return w;
}

Plan plan_of(const Laws& laws, const Bed& bed) {
    Plan plan;
    plan.grain = {pair_of(laws, 0), pair_of(laws, 1), pair_of(laws, 1), pair_of(laws, 2)};
    plan.wall = {pair_of(laws, 1), pair_of(laws, 2)};
    plan.clock.step = kStep;
    if (bed.shaking.frequency > 0)
        plan.clock.steps_per_period = std::llround(1 / (bed.shaking.frequency * kStep));
    plan.moving_walls = bed.shaking.amplitude > 0;
    return plan;
}

struct Apart {
    double position = 0, velocity = 0, spin = 0;  // m, m/s, rad/s; the largest difference of any grain
    std::int64_t met = 0;                         // number of contacts
};

Apart apart(const Plan& plan, const Plan& plain_plan, const Bed& bed) {
    const std::vector<ReferenceGrain> grains = grains_of(bed);
    HandMadeBed fast = fast_world(plan, bed, grains);
    ReferenceStep plain(plain_plan, faces_of(bed), bed.gravity, bed.shaking, grains);
    fast.run(bed.steps);
    plain.run(bed.steps);
    Apart most;
    most.met = plain.contacts_met();
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const auto id = static_cast<std::int32_t>(i);
        const ReferenceGrain& g = plain.grains()[i];
        most.position = std::max(most.position, (fast.position(id) - g.position).norm());
        most.velocity = std::max(most.velocity, (fast.velocity(id) - g.velocity).norm());
        most.spin = std::max(most.spin, (fast.spin(id) - g.spin).norm());
    }
    return most;
}

const Vec3 kDown(0, 0, -9.81), kNone(0, 0, 0);
const Bed kBeds[] = {{"settling", kDown, {0, 0, -0.6}, Container::Shape::wedge, {}, 2500},
                     {"shaken", kDown, {0, 0, -0.3}, Container::Shape::box, {1e-3, 125, {0, 0.6, 0.8}}, 2500},
                     {"flying", kNone, kNone, Container::Shape::cylinder, {}, 2500}};
// Differences of lengths are divided by the largest radius, differences of velocities by 1 m/s, and
// differences of spins by 1 m/s over the smallest radius. Rounding, 1e-16, grows with each collision by about
// the free path over the radius; measured differences are at most 1e-11, 1e-10 and 1e-10.
constexpr double kTolerance = 1e-8;

class ReferenceStepAgrees : public testing::TestWithParam<Laws> {};

TEST_P(ReferenceStepAgrees, OverSettlingShakenAndFlyingBeds) {
    for (const Bed& bed : kBeds) {
        const Plan plan = plan_of(GetParam(), bed);
        const Apart most = apart(plan, plan, bed);
        EXPECT_GT(most.met, 36) << bed.name << ": too few contacts to tell";
        EXPECT_LT(most.position, kTolerance * kSizes[0]) << bed.name;
        EXPECT_LT(most.velocity, kTolerance) << bed.name;
        EXPECT_LT(most.spin, kTolerance / kSizes[1]) << bed.name;
    }
}

// The tolerance is small enough that a formula that is wrong by one part in a million is noticed.
TEST(ReferenceStepTells, FrictionAndStiffnessThatAreOffByOneInAMillion) {
    const Laws laws{"", NormalForce::walton_braun_corrected, TangentialLaw::incremental_slip};
    const Bed& bed = kBeds[0];
    const Plan plan = plan_of(laws, bed);
    Plan rough = plan, stiff = plan;
    for (PairPlan& p : rough.grain) p.friction *= 1 + 1e-6;
    for (PairPlan& p : stiff.wall) p.loading_stiffness *= 1 + 1e-6;
    EXPECT_GT(apart(plan, rough, bed).spin, kTolerance / kSizes[1]);
    EXPECT_GT(apart(plan, stiff, bed).velocity, kTolerance);
}

INSTANTIATE_TEST_SUITE_P(
    AllLaws, ReferenceStepAgrees,
    testing::Values(
        Laws{"walton_braun_frictionless", NormalForce::walton_braun, TangentialLaw::none},
        Laws{"walton_braun_slip", NormalForce::walton_braun, TangentialLaw::incremental_slip},
        Laws{"walton_braun_linear_rolling", NormalForce::walton_braun, TangentialLaw::linear_spring, true},
        Laws{"corrected_frictionless", NormalForce::walton_braun_corrected, TangentialLaw::none},
        Laws{"corrected_slip_rolling", NormalForce::walton_braun_corrected, TangentialLaw::incremental_slip,
             true},
        Laws{"corrected_linear", NormalForce::walton_braun_corrected, TangentialLaw::linear_spring},
        Laws{"speed_slip", NormalForce::walton_braun_speed, TangentialLaw::incremental_slip},
        Laws{"table_slip", NormalForce::walton_braun_table, TangentialLaw::incremental_slip},
        Laws{"spring_dashpot_slip", NormalForce::spring_dashpot, TangentialLaw::incremental_slip},
        Laws{"spring_dashpot_linear_rolling", NormalForce::spring_dashpot, TangentialLaw::linear_spring,
             true},
        Laws{"spring_dashpot_attraction", NormalForce::spring_dashpot, TangentialLaw::linear_spring, false,
             true},
        Laws{"hertz_frictionless", NormalForce::hertz, TangentialLaw::none},
        Laws{"hertz_mindlin_rolling", NormalForce::hertz, TangentialLaw::mindlin, true},
        Laws{"hertz_mindlin_attraction", NormalForce::hertz, TangentialLaw::mindlin, false, true}),
    [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace grainreel
