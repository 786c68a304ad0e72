// Tests of the fabric tensor of contacts with known directions.
#include "engine/measure/bed/bed_formulas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace grainreel {
namespace {

TEST(Fabric, OfASimpleCubicLatticeIsIsotropic) {
    Fabric fabric;
    for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) fabric.add(n);
    EXPECT_NEAR(fabric.anisotropy(), 0, 1e-12);
    EXPECT_NEAR(fabric.vertical(), 1.0 / 3, 1e-12);
}

TEST(Fabric, OfUprightChainsIsOne) {
    Fabric fabric;
    for (int i = 0; i < 5; ++i) fabric.add({0, 0, i % 2 ? 1.0 : -1.0});
    EXPECT_NEAR(fabric.anisotropy(), 1, 1e-12);
    EXPECT_NEAR(fabric.vertical(), 1, 1e-12);
}

// The angle t of a normal against y has the density (1 + a cos 2t) / 2 pi (Rothenburg & Bathurst 1989, eq.
// 1). Its distribution is (t + a/2 sin 2t) / 2 pi, and the mean of cos^2 t is (1 + a/2) / 2.
TEST(Fabric, OfRothenburgsDistributionHasItsAnisotropy) {
    for (const double a : {-0.6, 0.0, 0.4}) {
        Fabric fabric;
        constexpr int count = 2000;
        for (int i = 0; i < count; ++i) {
            const double wanted = 2 * std::numbers::pi * (i + 0.5) / count;
            double t = wanted;
            for (int newton = 0; newton < 50; ++newton)
                t -= (t + 0.5 * a * std::sin(2 * t) - wanted) / (1 + a * std::cos(2 * t));
            fabric.add({0, std::cos(t), std::sin(t)});
        }
        EXPECT_NEAR(fabric.vertical(), 0.5 * (1 - 0.5 * a), 1e-6);
        EXPECT_NEAR(fabric.anisotropy(), 0.5 * (1 + 0.5 * std::abs(a)), 1e-6);  // no contact is along x
    }
}

TEST(Fabric, IsUndefinedWithoutContacts) {
    EXPECT_TRUE(std::isnan(Fabric().anisotropy()));
    EXPECT_TRUE(std::isnan(Fabric().vertical()));
}

}  // namespace
}  // namespace grainreel
