// On which side of a mesh the grains are, and which of its edges are drawn.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/page/bed/feature_edges.hpp"
#include "render/page/bed/grain_sides.hpp"
#include "tests/report/made_meshes.hpp"

namespace grainreel {
namespace {

using testing::Each;

const std::vector<Vec3> in_the_middle{{0.01, 0, -0.01}, {-0.01, 0.01, -0.02}, {0, -0.01, 0.01}};

// Of each triangle: the side that a point of the other side of its plane is not on.
void expect_towards(const Surface& surface, const std::vector<GrainSide>& sides, const Vec3& grains) {
    for (std::int32_t t = 0; t < surface.size(); ++t) {
        const bool front = surface.normal(t).dot(grains - surface.corner(t, 0)) > 0;
        EXPECT_EQ(sides[static_cast<std::size_t>(t)], front ? GrainSide::front : GrainSide::back) << t;
    }
}

TEST(GrainSides, OfAClosedVesselAreInIt) {
    TriangleMesh box;
    test::add_box(box, {-0.05, -0.04, -0.03}, {0.05, 0.04, 0.03});
    const auto surface = test::surface_of(box);
    expect_towards(*surface, grain_sides(surface, in_the_middle, {}, false), Vec3(0, 0, 0));
}

TEST(GrainSides, OfAThickWallAreInTheRoomAndInTheWall) {
    TriangleMesh box;
    test::add_box(box, {-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05});
    TriangleMesh room;
    test::add_box(room, {-0.04, -0.04, -0.04}, {0.04, 0.04, 0.04});
    const auto first = static_cast<std::int32_t>(box.vertices.size());
    box.vertices.insert(box.vertices.end(), room.vertices.begin(), room.vertices.end());
    for (const auto& t : room.triangles) box.triangles.push_back({first + t[0], first + t[2], first + t[1]});
    const auto surface = test::surface_of(box);
    expect_towards(*surface, grain_sides(surface, in_the_middle, {}, false), Vec3(0, 0, 0));
}

TEST(GrainSides, OfABladeAmongGrainsAreAllRound) {
    TriangleMesh blade;
    test::add_box(blade, {-0.05, 0.02, -0.03}, {0.05, 0.021, 0.03});
    EXPECT_THAT(grain_sides(test::surface_of(blade), in_the_middle, {}, false), Each(GrainSide::both));
}

TEST(GrainSides, OfAPlateAreAboveIt) {
    TriangleMesh plate;
    test::add_quad(plate, {-1, -1, -0.05}, {-1, 1, -0.05}, {1, 1, -0.05}, {1, -1, -0.05});  // it faces down
    EXPECT_THAT(grain_sides(test::surface_of(plate), in_the_middle, {}, false), Each(GrainSide::back));
}

// Its ends are open, so that it encloses no room; the axis tells, whatever heap the grains lie in.
TEST(GrainSides, OfATurningDrumAreAtItsAxis) {
    const auto drum = test::surface_of(test::tube(36, 0.05, 0.1));
    const BodyTurn turn{.axis = Vec3(1, 0, 0), .through = Vec3(0, 0, 0), .rate = 1};
    const std::vector<Vec3> heap{{0.05, 0.02, -0.04}, {0.05, 0.03, -0.03}};
    const std::vector<GrainSide> sides = grain_sides(drum, heap, turn, false);
    for (std::int32_t t = 0; t < drum->size(); ++t) {
        const Vec3 corner = drum->corner(t, 0);
        const bool inwards = drum->normal(t).dot(Vec3(0, corner.y(), corner.z())) < 0;
        EXPECT_EQ(sides[static_cast<std::size_t>(t)], inwards ? GrainSide::front : GrainSide::back);
    }
    EXPECT_THAT(grain_sides(drum, heap, {}, true), Each(GrainSide::both)) << "it tumbles";
    EXPECT_THAT(grain_sides(drum, {}, turn, false), Each(GrainSide::both)) << "there are no grains";
}

TEST(GrainSides, OfAPaddleThatTurnsAreOnBoth) {
    TriangleMesh paddle;
    test::add_quad(paddle, {0, 0, 0}, {0.1, 0, 0}, {0.1, 0.05, 0}, {0, 0.05, 0});  // its axis lies in it
    const BodyTurn turn{.axis = Vec3(1, 0, 0), .through = Vec3(0, 0, 0), .rate = 1};
    EXPECT_THAT(grain_sides(test::surface_of(paddle), in_the_middle, turn, false), Each(GrainSide::both));
}

TEST(FeatureEdges, AreThoseOfABoxAndTheRimsOfATube) {
    TriangleMesh box;
    test::add_box(box, {0, 0, 0}, {1, 2, 3});
    EXPECT_EQ(feature_edges(*test::surface_of(box)).size(), 12u);
    EXPECT_EQ(feature_edges(*test::surface_of(test::tube(36, 1, 1))).size(), 2 * 36u);
    EXPECT_EQ(feature_edges(*test::surface_of(test::tube(13, 1, 1))).size(), 2 * 13u) << "27.7 degrees";
    EXPECT_EQ(feature_edges(*test::surface_of(test::tube(11, 1, 1))).size(), 3 * 11u) << "32.7 degrees";
}

}  // namespace
}  // namespace grainreel
