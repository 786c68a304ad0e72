// Tests of jammed packings: random close packing without friction, and looser packing with friction.
#include "engine/lab/chart/validation/packing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace grainreel {
namespace {

using std::numbers::pi;

// A sphere that planes cut is whole, half, a quarter, or the cap pi h^2 (r - h/3).
TEST(Packing, VolumesOfCutSpheresAreExact) {
    const double r = 0.7, whole = 4.0 / 3 * pi * r * r * r, far = 10, h = 0.3;
    const Vec3 low(-far, -far, -far), centre(0, 1, 2);
    const auto up_to = [&](double y, double z) { return volume_within(centre, r, low, Vec3(far, y, z)); };
    EXPECT_NEAR(up_to(far, far), whole, 1e-12);
    EXPECT_NEAR(up_to(1, far), whole / 2, 1e-4 * whole);
    EXPECT_NEAR(up_to(far, 2), whole / 2, 1e-4 * whole);
    EXPECT_NEAR(up_to(1, 2), whole / 4, 1e-4 * whole);
    EXPECT_NEAR(up_to(1 - r + h, far), pi * h * h * (r - h / 3), 1e-4 * whole);
    EXPECT_NEAR(up_to(far, 2 - r + h), pi * h * h * (r - h / 3), 1e-4 * whole);
    EXPECT_EQ(up_to(1 - r, far), 0);
}

// O'Hern, Silbert, Liu & Nagel (2003, Phys. Rev. E 68, 011306) found for infinite systems 0.639 +- 0.001 and
// 5.97 +- 0.03, isostatic, and z - z_c = (7.9 +- 0.5) sqrt(phi - phi_c). The tolerances are three times the
// scatter of seeds in a packing as small as this one.
TEST(Packing, SmoothSpheresJamAtRandomClosePacking) {
    JammedPacking packing;
    packing.grains = 1500;
    packing.margin = 2.5;
    const JammingPoint point = jamming_point(decompress(packing, 9));
    std::printf("[ measured ] solid fraction %.4f, contacts %.3f, rise %.2f\n", point.solid_fraction,
                point.contacts, point.rise);
    EXPECT_NEAR(point.solid_fraction, 0.639, 0.012);
    EXPECT_NEAR(point.contacts, 6, 0.15);
    EXPECT_NEAR(point.rise, 7.9, 1.5);
}

// Silbert (2010, Soft Matter 6, 2918): with friction a packing goes from close to loose random packing, 0.555
// (Onoda & Liniger 1990, Phys. Rev. Lett. 64, 2727), and from about six contacts to four. These are means of
// packings, because the contacts of a single one of this size scatter by 0.15 (8 of them: 3.98 to 4.44).
TEST(Packing, RoughSpheresJamLooser) {
    constexpr int packings = 4;
    double solid_fraction = 0, contacts = 0;
    for (int seed = 1; seed <= packings; ++seed) {
        JammedPacking packing;
        packing.grains = 1000;
        packing.margin = 2;
        packing.friction = 0.5;
        packing.seed = seed;
        const JammingPoint point = jamming_point(decompress(packing, 6));
        std::printf("[ measured ] solid fraction %.4f, contacts %.3f\n", point.solid_fraction,
                    point.contacts);
        solid_fraction += point.solid_fraction / packings, contacts += point.contacts / packings;
    }
    EXPECT_GT(solid_fraction, 0.55);
    EXPECT_LT(solid_fraction, 0.60);
    EXPECT_GT(contacts, 4);
    EXPECT_LT(contacts, 4.8);
}

}  // namespace
}  // namespace grainreel
