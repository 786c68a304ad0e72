#include <gmock/gmock.h>

#include "tests/mesh/shapes.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

// Six times the signed volume.
double six_volumes(const TriangleMesh& mesh) {
    double sum = 0;
    for (const TriangleMesh::Triangle& t : mesh.triangles)
        sum += mesh.vertices[static_cast<std::size_t>(t[0])].dot(
            mesh.vertices[static_cast<std::size_t>(t[1])].cross(
                mesh.vertices[static_cast<std::size_t>(t[2])]));
    return sum;
}

TEST(Mending, ASoundBoxHasOnlyItsCornersJoined) {
    TriangleMesh mesh = shapes::box({-1, -2, -3}, {1, 2, 3});
    MeshFacts facts;
    mend(mesh, facts);
    EXPECT_EQ(facts.triangles, 12);
    EXPECT_EQ(facts.vertices, 8);
    EXPECT_EQ(facts.welded, 36 - 8);
    EXPECT_EQ(facts.dropped + facts.doubled + facts.flipped + facts.slender, 0);
    EXPECT_EQ(facts.solids, 1);
    EXPECT_TRUE(facts.closed());
    EXPECT_EQ(facts.low, Vec3(-1, -2, -3));
    EXPECT_EQ(facts.high, Vec3(1, 2, 3));
    EXPECT_THAT(facts.mended, ElementsAre("28 vertices were joined with others in their place"));
    EXPECT_DOUBLE_EQ(six_volumes(mesh), 6 * 2 * 4 * 6);
}

TEST(Mending, OpenEdgesAndPartsAreCounted) {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {1, 1, 1}, false);
    shapes::add(mesh, shapes::box({5, 0, 0}, {6, 1, 1}));
    shapes::add(mesh, shapes::box({6, 1, 1}, {7, 2, 2}));  // has a corner with the second box in common
    MeshFacts facts;
    mend(mesh, facts);
    EXPECT_EQ(facts.open_edges, 4);
    EXPECT_EQ(facts.crowded_edges, 0);
    EXPECT_EQ(facts.solids, 3);
    EXPECT_FALSE(facts.closed());
}

TEST(Mending, EdgesOfThreeTrianglesAreCrowdedAndHoldPartsTogether) {
    TriangleMesh mesh = shapes::sheet(1, 1, [](double, double) { return 0.0; });
    shapes::add_triangle(mesh, {-1, -1, 0}, {1, 1, 0}, {0, 0, 1});  // stands on the diagonal
    MeshFacts facts;
    mend(mesh, facts);
    EXPECT_EQ(facts.crowded_edges, 1);
    EXPECT_EQ(facts.open_edges, 6);
    EXPECT_EQ(facts.solids, 1);
}

TEST(Mending, TrianglesWithoutAreaAndDoubledOnesGo) {
    TriangleMesh mesh = shapes::sheet(1, 4, [](double, double) { return 0.0; });
    const TriangleMesh all = mesh;
    shapes::add_triangle(mesh, {0, 0, 0}, {0.5, 0.5, 0}, {1, 1, 0});
    shapes::add_triangle(mesh, {0, 0, 0}, {0, 0, 0}, {1, 1, 0});
    shapes::add_triangle(mesh, {1, 1, 0}, {1, 1, 0}, {1, 1, 0});
    shapes::add_triangle(mesh, {-1, -1, 0}, {1, -1, 0}, {0, -1 + 1e-10, 0});
    shapes::add(mesh, all);
    shapes::add(mesh, shapes::inside_out(all));
    MeshFacts facts;
    mend(mesh, facts);
    EXPECT_EQ(facts.dropped, 4);
    EXPECT_EQ(facts.doubled, 64);
    EXPECT_EQ(facts.triangles, 32);
    EXPECT_EQ(facts.vertices, 25);
    EXPECT_EQ(facts.open_edges, 16);
    EXPECT_EQ(facts.flipped, 0);
}

TEST(Mending, CornersCloserThanABillionthOfTheExtentAreOne) {
    for (const double apart : {0.9e-9, 1.1e-4}) {
        TriangleMesh mesh = shapes::box({0, 0, 0}, {1, 1, 1});
        for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) mesh.vertices[i].x() += apart;
        MeshFacts facts;
        mend(mesh, facts);
        EXPECT_EQ(facts.closed(), apart < 1e-9) << apart;
    }
}

TEST(Mending, CracksAlongOpenEdgesAreClosed) {
    TriangleMesh mesh = shapes::turned({{1, 0}, {1, 1}, {0.2, 2}}, 24, true, true);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        mesh.vertices[i].y() += 1e-6 * static_cast<double>(i % 3);
    MeshFacts facts;
    mend(mesh, facts);
    EXPECT_TRUE(facts.closed());
    EXPECT_EQ(facts.vertices, 3 * 24 + 2);
    EXPECT_THAT(facts.mended, Contains(tells({"vertices", "open edges", "joined"})));
}

TEST(Mending, TwoPlatesThatNearlyTouchStayTwo) {
    TriangleMesh mesh = shapes::sheet(1, 2, [](double, double) { return 0.0; });
    shapes::add(mesh, shapes::sheet(1, 2, [](double, double) { return 1e-4; }));
    MeshFacts facts;
    mend(mesh, facts);
    EXPECT_EQ(facts.triangles, 16);
    EXPECT_EQ(facts.solids, 2);
}

TEST(Mending, MinoritiesAreTurnedRound) {
    const TriangleMesh sound = shapes::turned({{1, 0}, {1, 1}}, 12, true, true);  // 48 triangles
    for (const bool inwards : {false, true}) {
        TriangleMesh mesh = inwards ? shapes::inside_out(sound) : sound;
        for (std::size_t i = 0; i < 5; ++i) std::swap(mesh.triangles[7 * i][1], mesh.triangles[7 * i][2]);
        MeshFacts facts;
        mend(mesh, facts);
        EXPECT_EQ(facts.flipped, 5);
        EXPECT_EQ(facts.solids, 1);
        EXPECT_NEAR(six_volumes(mesh), (inwards ? -6 : 6) * shapes::polygon(1, 12), 1e-12);
    }
}

TEST(Mending, AClosedPartWithoutAnyOrderComesToFaceOutwards) {
    TriangleMesh mesh = shapes::inside_out(shapes::turned({{1, 0}, {1, 1}}, 12, true, true));
    for (std::size_t i = 0; i < 20; ++i) std::swap(mesh.triangles[2 * i][1], mesh.triangles[2 * i][2]);
    MeshFacts facts;
    mend(mesh, facts);
    EXPECT_EQ(facts.flipped, 48 - 20);
    EXPECT_NEAR(six_volumes(mesh), 6 * shapes::polygon(1, 12), 1e-12);
}

TEST(Mending, TheInnerSideOfAHollowWallKeepsFacingInwards) {
    TriangleMesh mesh = shapes::box({-2, -2, -2}, {2, 2, 2});
    shapes::add(mesh, shapes::inside_out(shapes::box({-1, -1, -1}, {1, 1, 1})));
    MeshFacts facts;
    mend(mesh, facts);
    EXPECT_EQ(facts.flipped, 0);
    EXPECT_DOUBLE_EQ(six_volumes(mesh), 6 * (64 - 8));
}

TEST(Mending, AMoebiusStripStaysAsItIs) {
    constexpr int count = 12;
    TriangleMesh mesh;
    const auto at = [](int i, double across) {
        const double angle = 2 * std::numbers::pi * i / count, r = 1 + 0.2 * across * std::cos(0.5 * angle);
        return Vec3(r * std::cos(angle), r * std::sin(angle), 0.2 * across * std::sin(0.5 * angle));
    };
    for (int i = 0; i < count; ++i) shapes::add_quad(mesh, at(i, -1), at(i + 1, -1), at(i + 1, 1), at(i, 1));
    MeshFacts facts;
    mend(mesh, facts);
    EXPECT_EQ(facts.flipped, 0);
    EXPECT_EQ(facts.open_edges, 2 * count);
    const Surface surface(mesh, facts, "");
    int flips = 0;
    for (std::int32_t t = 0; t < surface.size(); ++t)
        for (int e = 0; e < 3; ++e) flips += surface.neighbour(t, e).flips;
    EXPECT_EQ(flips, 2);  // one edge, from both sides
}

TEST(Mending, SlenderTrianglesAreCounted) {
    TriangleMesh mesh;
    shapes::add_triangle(mesh, {0, 0, 0}, {1, 0, 0}, {0.5, 1.1e-3, 0});
    shapes::add_triangle(mesh, {0, 0, 1}, {1, 0, 1}, {0.5, 0.9e-3, 1});
    MeshFacts facts;
    mend(mesh, facts);
    EXPECT_EQ(facts.slender, 1);
    EXPECT_THAT(facts.mended, IsEmpty());
}

}  // namespace
}  // namespace grainreel
