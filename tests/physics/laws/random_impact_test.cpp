// Tests of ten thousand impacts of two bodies, drawn at random: none makes energy, and all keep momentum.
#include <gtest/gtest.h>

#include <random>

#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

struct Outcome {
    double gained;   // kinetic energy, divided by what the contact point brought in
    double linear;   // change of momentum, divided by the momentum before
    double angular;  // the same for angular momentum
    bool met;
};

class RandomImpacts {
  public:
    explicit RandomImpacts(NormalForce normal, TangentialLaw tangential, std::uint64_t seed)
        : normal_(normal), tangential_(tangential), random_(seed) {}

    Outcome next() {
        const double e = 0.05 + 0.95 * share(), mu = 2 * share(), ratio = std::pow(20.0, share());
        const double small = kRadius, big = ratio * kRadius;
        const double effective = 1 / (1 / sphere_mass(small) + 1 / sphere_mass(big));
        const double time = pi / 2 * (1 + e) * std::sqrt(effective / kStiffness);
        const double steps = std::max(12.0, 9.5 - 8 * std::log(e));
        HandMadeBed w = make_world(walton_braun_pair(e, mu), time / steps, normal_, tangential_);
        const Vec3 k = direction();
        const double gap = 1e-3 * small * share(), speed = 0.3;
        w.grains.add(0, 0, Vec3(0, 0, 0), small, kDensity);
        w.grains.add(1, 0, (small + big + gap) * k, big, kDensity);
        Vec3 towards = direction();
        if (towards.dot(k) < 0) towards = -towards;
        w.grains.motion[0].velocity = speed * towards;
        w.grains.motion[0].spin = speed / small * share() * direction();
        w.grains.motion[1].spin = speed / big * share() * direction();
        w.around.skin = 0.2 * small;
        w.start();
        const Kinetic before = kinetic_energy(w.grains);
        const auto [linear, angular] = momenta(w);
        const double closing = speed * towards.dot(k);
        w.run(static_cast<std::int64_t>((gap / closing + 1.5 * time) / w.plan.clock.step) + 50);
        const Kinetic after = kinetic_energy(w.grains);
        const auto [linear_after, angular_after] = momenta(w);
        const double total = before.translation + before.rotation;
        return {(after.translation + after.rotation - total) / total,
                (linear_after - linear).norm() / linear.norm(),
                (angular_after - angular).norm() / (angular.norm() + linear.norm() * small),
                std::abs(after.translation - before.translation) > 1e-6 * total};
    }

  private:
    double share() { return std::uniform_real_distribution<double>(0, 1)(random_); }
    Vec3 direction() {
        std::normal_distribution<double> normal;
        return Vec3(normal(random_), normal(random_), normal(random_)).normalized();
    }
    static std::pair<Vec3, Vec3> momenta(const HandMadeBed& w) {
        Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
        for (std::size_t i = 0; i < w.grains.size(); ++i) {
            const Vec3 p = w.grains.mass(i) * w.grains.motion[i].velocity;
            linear += p;
            angular += w.grains.place[i].position.cross(p) + w.grains.inertia(i) * w.grains.motion[i].spin;
        }
        return {linear, angular};
    }

    NormalForce normal_;
    TangentialLaw tangential_;
    std::mt19937_64 random_;
};

// bound: for the energy made, divided by the kinetic energy that came in.
void expect_none_makes_energy(NormalForce normal, TangentialLaw tangential, int impacts, double bound) {
    RandomImpacts random(normal, tangential, 17);
    double most = -1, linear = 0, angular = 0;
    int met = 0;
    for (int k = 0; k < impacts; ++k) {
        const Outcome o = random.next();
        if (o.met) most = std::max(most, o.gained);
        linear = std::max(linear, o.linear);
        angular = std::max(angular, o.angular);
        met += o.met;
    }
    EXPECT_GT(met, 0.9 * impacts);
    EXPECT_LT(most, bound);
    EXPECT_LT(linear, 1e-12);
    EXPECT_LT(angular, of_rounding(1e-11, 3e-7));
    std::printf("[ measured ] the least dissipative left %.3e of its energy behind\n", -most);
}

TEST(RandomImpacts, MakeNoEnergyWithWaltonBraunAndIncrementalSlip) {
    expect_none_makes_energy(NormalForce::walton_braun, TangentialLaw::incremental_slip, 10000, 0.01);
}

TEST(RandomImpacts, MakeNoEnergyWithALinearSpring) {
    expect_none_makes_energy(NormalForce::walton_braun, TangentialLaw::linear_spring, 2000, 0.01);
}

TEST(RandomImpacts, MakeNoEnergyWithCorrections) {
    expect_none_makes_energy(NormalForce::walton_braun_corrected, TangentialLaw::incremental_slip, 2000,
                             0.01);
}

}  // namespace
}  // namespace grainreel
