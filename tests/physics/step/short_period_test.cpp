// Tests of the shortest period that a scene may have, 2.5 diameters of the largest grain. Each grain meets
// the nearest image of every other. So a bed moves in the same way as twice the bed in twice the period.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

constexpr double kPeriod = 2.5 * 2 * kRadius;
constexpr int kGrains = 2 * 4 * 4;

// Grains of two sizes fly into each other over a floor; `copies` of them side by side along x.
HandMadeBed bed(int copies, int threads) {
    const double contact = std::numbers::pi * std::sqrt(sphere_mass() / 2 / kStiffness);
    HandMadeBed w = make_world(walton_braun_pair(0.8, 0.4), contact / 40);
    w.team = std::make_unique<Team>(threads);
    w.around.gravity = {0, 0, -9.81};
    w.around.faces = {floor_face()};
    w.around.period = copies * kPeriod;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> shift(-0.05, 0.05), speed(-0.5, 0.5);
    for (int i = 0; i < kGrains; ++i) {
        const double radius = (i % 3 == 0 ? 0.8 : 1) * kRadius;
        const Vec3 site(0.5 + i % 2, i / 2 % 4, 0.5 + i / 8);
        const Vec3 place = 1.25 * 2 * kRadius * (site + Vec3(shift(random), shift(random), shift(random)));
        const Vec3 velocity(speed(random), speed(random), speed(random));
        for (int copy = 0; copy < copies; ++copy) {
            const double x = place.x() + (copy - 0.5 * copies) * kPeriod;
            w.grains.add(i + copy * kGrains, 0, Vec3(x, place.y(), place.z()), radius, kDensity);
            w.grains.motion.back().velocity = velocity;
        }
    }
    w.start();
    return w;
}

TEST(ShortPeriod, IsAsTwiceTheBedInTwiceThePeriod) {
    HandMadeBed one = bed(1, 1), two = bed(2, 1);
    const double before = one.energy();
    constexpr int kSteps = 6000;  // 10 ms: several impacts a grain
    one.run(kSteps), two.run(kSteps);
    double moved = 0;
    for (std::int32_t i = 0; i < kGrains; ++i) {
        moved = std::max(moved, one.velocity(i).norm());
        for (const std::int32_t copy : {i, i + kGrains}) {
            Vec3 apart = two.position(copy) - one.position(i);
            apart.x() -= kPeriod * std::round(2 * apart.x() / kPeriod) / 2;
            EXPECT_LT(apart.norm(), of_rounding(1e-8, 1e-4) * kRadius) << copy;
            EXPECT_LT((two.velocity(copy) - one.velocity(i)).norm(), of_rounding(1e-8, 1e-3)) << copy;
        }
    }
    EXPECT_GT(moved, 0.1);
    EXPECT_LT(one.energy(), 0.9 * before) << "they have met";
    EXPECT_NEAR(two.energy(), 2 * one.energy(), of_rounding(1e-9, 1e-5) * one.energy());
}

TEST(ShortPeriod, HasTheSameBitsOnAnyNumberOfThreads) {
    HandMadeBed one = bed(1, 1);
    one.run(1000);
    for (const int threads : {2, 3}) {
        HandMadeBed more = bed(1, threads);
        more.run(1000);
        for (std::int32_t i = 0; i < kGrains; ++i) EXPECT_EQ(more.position(i), one.position(i)) << i;
    }
}

}  // namespace
}  // namespace grainreel
