// Tests that a grain touches a mesh once for each patch of surface, whatever the triangles are.
#include "engine/step/geometry/patches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/physics/step/mesh_world.hpp"

namespace grainreel {
namespace {

constexpr double kSize = 1, kRadiusHere = 0.1;

// The patches found when the triangles are asked in a random order.
std::vector<Patch> patches_of(const Surface& surface, const Vec3& centre, double radius = kRadiusHere) {
    std::vector<std::int32_t> near;
    surface.near(centre, radius, near);
    static std::mt19937 random(1);
    std::shuffle(near.begin(), near.end(), random);
    Patches patches;
    patches.begin(surface, centre, radius);
    for (const std::int32_t triangle : near) patches.add(triangle);
    patches.find();
    for (std::size_t p = 0; p < patches.all().size(); ++p)
        EXPECT_EQ(patches.holder_of(patches.all()[p].triangle), static_cast<int>(p));
    return patches.all();
}

TEST(Patches, APlaneIsTouchedOnceWhateverItsTriangles) {
    for (const int n : {1, 3, 20, 80}) {
        const auto surface = surface_of(square_mesh(kSize, n));
        std::mt19937_64 random(2);
        std::uniform_real_distribution<double> place(-0.35, 0.35);
        for (int k = 0; k < 200; ++k) {
            Vec3 centre(place(random), place(random), k % 2 ? 0.09 : -0.09);
            if (k % 5 == 0) centre.x() = std::round(centre.x() * n) / n;   // above a seam
            if (k % 10 == 0) centre.y() = std::round(centre.y() * n) / n;  // above a vertex
            const auto found = patches_of(*surface, centre);
            ASSERT_EQ(found.size(), 1u) << n << " " << centre.transpose();
            EXPECT_NEAR(found[0].distance, 0.09, 1e-15);
            EXPECT_NEAR(found[0].normal.z(), k % 2 ? -1 : 1, 1e-12);
        }
    }
}

TEST(Patches, TheRimOfASheetIsTouchedAtItsNearestPoint) {
    const auto surface = surface_of(square_mesh(kSize, 4));
    const Vec3 centre(0.5 + 0.03, 0.1, 0.04);
    const auto found = patches_of(*surface, centre);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].distance, 0.05, 1e-15);
    EXPECT_LT((found[0].at - Vec3(0.5, 0.1, 0)).norm(), 1e-15);
}

TEST(Patches, AConvexEdgeCountsOnce) {
    const auto surface = surface_of(box_mesh(Vec3(-1, -1, -1), Vec3(0, 0, 0), 5));
    for (double angle = -1.2; angle < 2.8; angle += 0.05) {
        const Vec3 out(std::cos(angle), 0, std::sin(angle));
        Vec3 centre = 0.09 * out + Vec3(0, -0.5, 0);
        if (out.z() < 0) centre = Vec3(0.09, -0.5, 0.09 * out.z());
        if (out.x() < 0) centre = Vec3(0.09 * out.x(), -0.5, 0.09);
        const auto found = patches_of(*surface, centre);
        ASSERT_EQ(found.size(), 1u) << angle;
        EXPECT_NEAR(found[0].distance, 0.09, 1e-15) << angle;
    }
    EXPECT_EQ(patches_of(*surface, Vec3(0.04, 0.04, 0.04)).size(), 1u);  // the corner
    EXPECT_EQ(patches_of(*surface, Vec3(0.04, -0.02, 0.04)).size(), 1u);
}

TEST(Patches, InABoxEachSideCounts) {
    const auto surface = surface_of(box_mesh(Vec3(-1, -1, -1), Vec3(0, 0, 0), 5));
    EXPECT_EQ(patches_of(*surface, Vec3(-0.5, -0.5, -0.09)).size(), 1u);
    EXPECT_EQ(patches_of(*surface, Vec3(-0.5, -0.08, -0.09)).size(), 2u);
    EXPECT_EQ(patches_of(*surface, Vec3(-0.07, -0.08, -0.09)).size(), 3u);
    // This place is far from the side wall: its edge with the floor is within reach, but the floor is nearer.
    EXPECT_EQ(patches_of(*surface, Vec3(-0.5, -0.09, -0.02)).size(), 2u);
}

int touched_in_groove(double angle, const Vec3& centre, int n) {
    const auto surface = surface_of(groove_mesh(kSize, angle / 2, angle / 2, n));
    return static_cast<int>(patches_of(*surface, centre).size());
}

TEST(Patches, AGrooveCountsTwiceUnlessItIsShallow) {
    const double degree = std::numbers::pi / 180;
    for (const int n : {1, 6}) {
        EXPECT_EQ(touched_in_groove(90 * degree, Vec3(0.1, 0, 0.09 * std::sqrt(2.0)), n), 2);
        EXPECT_EQ(touched_in_groove(40 * degree, Vec3(0.1, 0, 0.0999), n), 2);
        EXPECT_EQ(touched_in_groove(5 * degree, Vec3(0.1, 0, 0.0999), n), 1);
        // The grain lies on one side of the groove, with the edge within reach.
        const double tilt = 6 * degree;
        const Vec3 on_right = Vec3(0.1, 0.03 * std::cos(tilt) - 0.09 * std::sin(tilt),
                                   0.03 * std::sin(tilt) + 0.09 * std::cos(tilt));
        EXPECT_EQ(touched_in_groove(2 * tilt, on_right, n), 1);
        // From below it is a ridge.
        EXPECT_EQ(touched_in_groove(90 * degree, Vec3(0.1, 0, -0.05), n), 1);
        EXPECT_EQ(touched_in_groove(40 * degree, Vec3(0.1, 0.01, -0.05), n), 1);
    }
}

TEST(Patches, TheTipOfAConeIsOnePlaceWhateverItsSides) {
    for (const int sides : {3, 10, 50, 360}) {
        for (const double height : {0.2, 1.0, 8.0}) {
            const auto surface = surface_of(cone_mesh(1, height, sides));
            for (const Vec3& up : {Vec3(0, 0, 1), Vec3(0.01, 0.02, 1).normalized()}) {
                const auto found = patches_of(*surface, 0.09 * up);
                ASSERT_EQ(found.size(), 1u) << sides << " " << height;
                EXPECT_NEAR(found[0].distance, 0.09, 1e-15);
                EXPECT_LT((found[0].normal + up).norm(), 1e-12);
            }
        }
    }
}

// From a direction in the polar cone of a needle's tip, half of its sides may be seen from behind.
TEST(Patches, ANeedleIsTouchedOnceFromTheSide) {
    for (const int sides : {10, 50}) {
        const auto surface = surface_of(cone_mesh(0.05, 1, sides));
        for (double angle = 0; angle < 6.3; angle += 0.1) {
            const Vec3 out = Vec3(std::cos(angle), std::sin(angle), 0.3).normalized();
            const auto found = patches_of(*surface, 0.05 * out);
            ASSERT_EQ(found.size(), 1u) << sides << " " << angle;
            EXPECT_NEAR(found[0].distance, 0.05, 1e-15);
        }
    }
}

// Facets that turn by less than 10.5 degrees are one wall, at every place inside.
TEST(Patches, ARoundTubeIsTouchedOnce) {
    for (const int facets : {36, 90, 360}) {
        const auto surface = surface_of(tube_mesh(1, 2, facets, 8));
        for (double angle = 0; angle < 6.3; angle += 0.013) {
            const Vec3 centre(0.905 * std::cos(angle), 0.905 * std::sin(angle), 0.13);
            const auto found = patches_of(*surface, centre);
            ASSERT_EQ(found.size(), 1u) << facets << " " << angle;
            EXPECT_NEAR(found[0].distance, 0.095, 1 - std::cos(std::numbers::pi / facets) + 1e-12);
        }
    }
}

TEST(Patches, ACentreInTheSurfaceHasNoDistance) {
    const auto surface = surface_of(square_mesh(kSize, 3));
    const auto found = patches_of(*surface, Vec3(0.1, 0.03, 0));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].distance, 0);
}

}  // namespace
}  // namespace grainreel
