#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "engine/mesh/room.hpp"
#include "tests/mesh/shapes.hpp"

namespace grainreel {
namespace {

EnclosedRoom room_of(TriangleMesh mesh) {
    return EnclosedRoom(shapes::mended(std::move(mesh)));
}

// A vessel of revolution with a wall: closed, its hollow is open above.
TriangleMesh cup(double inner, double outer, double floor, double height, int sides) {
    return shapes::turned({{outer, 0}, {outer, height}, {inner, height}, {inner, floor}, {0, floor}}, sides,
                          true, false);
}

TEST(RoomOfAMesh, OfABoxIsTheBox) {
    for (const bool lid : {true, false})
        for (const bool inwards : {true, false}) {
            const TriangleMesh mesh = shapes::box({-1, -2, 0.5}, {1, 2, 3.5}, lid);
            const EnclosedRoom room = room_of(inwards ? shapes::inside_out(mesh) : mesh);
            EXPECT_NEAR(room.volume(), 2 * 4 * 3, 1e-12);
            EXPECT_NEAR(room.volume_below(1.25), 2 * 4 * 0.75, 1e-12);
            EXPECT_EQ(room.volume_below(0.4), 0);
            EXPECT_EQ(room.volume_below(9), room.volume());
            EXPECT_EQ(room.base(), 0.5);
            EXPECT_EQ(room.top(), 3.5);
            EXPECT_NEAR(room.area_at(2), 8, 1e-12);
            EXPECT_EQ(room.area_at(3.6), 0);
            EXPECT_NEAR(room.half_width_at(2), 2, 1e-12);
            EXPECT_NEAR(room.half_depth_at(2), 1, 1e-12);
            EXPECT_EQ(room.open_above(), !lid);
            EXPECT_FALSE(room.open_below());
            EXPECT_TRUE(room.encloses_anything());
            EXPECT_TRUE(room.holds({0.99, -1.99, 0.51}));
            EXPECT_FALSE(room.holds({1.01, 0, 1}));
            EXPECT_FALSE(room.holds({0, 0, 0.49}));
            EXPECT_FALSE(room.holds({0, 0, 3.51}));
            EXPECT_TRUE(room.holds({0.8, 0, 1}, 0.19));
            EXPECT_FALSE(room.holds({0.8, 0, 1}, 0.21));
            EXPECT_TRUE(room.holds(room.widest_place(), 0.5));
        }
}

TEST(RoomOfAMesh, OfACylinderAndAConeAreThoseOfTheirPolygons) {
    for (const int sides : {6, 36, 360}) {
        const EnclosedRoom cylinder = room_of(shapes::turned({{0.1, 0}, {0.1, 0.3}}, sides, true, false));
        const double rounding = sides > 200 ? 1e-5 : 1e-9;  // up to 512 corners of a section are exact
        EXPECT_NEAR(cylinder.volume() / (0.3 * shapes::polygon(0.1, sides)), 1, rounding);
        EXPECT_NEAR(cylinder.half_depth_at(0.2), 0.1, 1e-12);
        const EnclosedRoom cone = room_of(shapes::turned({{0, 0}, {0.1, 0.3}}, sides, false, true));
        EXPECT_NEAR(cone.volume() / (0.1 * shapes::polygon(0.1, sides)), 1, rounding);
        EXPECT_NEAR(cone.volume_below(0.15) / cone.volume(), 0.125, 1e-3);
        EXPECT_NEAR(cone.half_depth_at(0.15), 0.05, 1e-12);
        EXPECT_EQ(cone.base(), 0);
    }
}

// A cylinder over a cone over an orifice; open below and above.
TEST(RoomOfAMesh, OfAHopperWithoutABottom) {
    constexpr int sides = 48;
    const EnclosedRoom room =
        room_of(shapes::turned({{0.03, -0.05}, {0.1, 0.02}, {0.1, 0.3}}, sides, false, false));
    EXPECT_NEAR(room.volume(), shapes::frustum(0.03, 0.1, 0.07, sides) + 0.28 * shapes::polygon(0.1, sides),
                1e-12);
    EXPECT_EQ(room.base(), -0.05);
    EXPECT_EQ(room.top(), 0.3);
    EXPECT_TRUE(room.open_above());
    EXPECT_TRUE(room.open_below());
    EXPECT_TRUE(room.holds({0.02, 0, -0.049}));
    EXPECT_FALSE(room.holds({0.09, 0, -0.04}));  // beside the cone
    EXPECT_FALSE(room.holds({0, 0, -0.06}));
    EXPECT_NEAR(room.half_depth_at(-0.015), 0.065, 1e-12);
}

TEST(RoomOfAMesh, OfACupWithAWallIsItsHollow) {
    constexpr int sides = 24;
    for (const bool inwards : {false, true}) {
        const TriangleMesh mesh = cup(0.1, 0.12, 0.02, 0.3, sides);
        const EnclosedRoom room = room_of(inwards ? shapes::inside_out(mesh) : mesh);
        EXPECT_NEAR(room.volume(), 0.28 * shapes::polygon(0.1, sides), 1e-12);
        EXPECT_EQ(room.base(), 0.02);
        EXPECT_EQ(room.top(), 0.3);
        EXPECT_NEAR(room.half_depth_at(0.1), 0.1, 1e-12);
        EXPECT_TRUE(room.holds({0.05, 0.05, 0.1}));
        EXPECT_FALSE(room.holds({0.11, 0, 0.1}));    // in the wall
        EXPECT_FALSE(room.holds({0.05, 0, 0.015}));  // in the floor
        EXPECT_TRUE(room.open_above());
    }
}

TEST(RoomOfAMesh, OfAHollowBlockIsItsHollow) {
    TriangleMesh mesh = shapes::box({-2, -2, -2}, {2, 2, 2});
    shapes::add(mesh, shapes::inside_out(shapes::box({-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5})));
    const EnclosedRoom room = room_of(mesh);
    EXPECT_NEAR(room.volume(), 27, 1e-11);
    EXPECT_EQ(room.base(), -1.5);
    EXPECT_FALSE(room.holds({1.75, 0, 0}));
    EXPECT_TRUE(room.holds({1.25, 0, 0}));
}

TEST(RoomOfAMesh, SolidsInItAreNotOfIt) {
    for (const bool lid : {true, false}) {  // a closed vessel, and an open sheet
        TriangleMesh mesh = shapes::box({-2, -2, 0}, {2, 2, 4}, lid);
        shapes::add(mesh, shapes::box({-1, -1, 1}, {1, 1, 3}));
        const EnclosedRoom room = room_of(mesh);
        EXPECT_NEAR(room.volume(), 64 - 8, 1e-11);
        EXPECT_NEAR(room.volume_below(2), 32 - 4, 1e-11);
        EXPECT_FALSE(room.holds({0, 0, 2}));
        EXPECT_TRUE(room.holds({1.5, 0, 2}));
        EXPECT_TRUE(room.holds({0, 0, 3.5}));
    }
}

TEST(RoomOfAMesh, SheetsInItChangeNothing) {
    TriangleMesh mesh = shapes::box({-2, -2, 0}, {2, 2, 4});
    shapes::add_quad(mesh, {0, -1, 1}, {0, 1, 1}, {0, 1, 3}, {0, -1, 3});
    const EnclosedRoom room = room_of(mesh);
    EXPECT_NEAR(room.volume(), 64, 1e-11);
    EXPECT_TRUE(room.holds({0.01, 0, 2}));
    EXPECT_TRUE(room.holds({-0.01, 0, 2}));
}

// Most places are answered by a grid; what it says is what the shape says.
TEST(RoomOfAMesh, HoldsWhatTheShapeHolds) {
    constexpr int sides = 30;
    TriangleMesh mesh = cup(0.1, 0.12, 0.02, 0.3, sides);
    shapes::add(mesh, shapes::box({-0.03, -0.02, 0.1}, {0.03, 0.02, 0.2}));
    const EnclosedRoom room = room_of(mesh);
    const double apothem = 0.1 * std::cos(std::numbers::pi / sides);
    std::mt19937 random(3);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    int inside = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 place(between(-0.13, 0.13), between(-0.13, 0.13), between(-0.01, 0.31));
        double farthest = 0;  // across the sides
        for (int k = 0; k < sides; ++k) {
            const double angle = 2 * std::numbers::pi * (k + 0.5) / sides;
            farthest = std::max(farthest, place.x() * std::cos(angle) + place.y() * std::sin(angle));
        }
        const bool solid =
            std::abs(place.x()) < 0.03 && std::abs(place.y()) < 0.02 && place.z() > 0.1 && place.z() < 0.2;
        const bool expected = farthest < apothem && place.z() > 0.02 && place.z() < 0.3 && !solid;
        EXPECT_EQ(room.holds(place), expected) << place.transpose();
        inside += expected;
    }
    EXPECT_GT(inside, 5000);
}

// Pits in a landscape are rooms, though all the air above them hangs together.
TEST(RoomOfAMesh, PitsAreToldFromTheAirAboveThem) {
    const EnclosedRoom room = room_of(shapes::sheet(1, 60, [](double x, double y) {
        return 0.5 * std::sin(std::numbers::pi * x) * std::sin(std::numbers::pi * y);
    }));
    for (const double x : {-0.5, 0.5}) {
        EXPECT_TRUE(room.holds({x, -x, -0.1}));   // deep in a pit
        EXPECT_FALSE(room.holds({x, x, -0.1}));   // below a hill
        EXPECT_FALSE(room.holds({x, -x, 0.45}));  // over the pit
    }
    EXPECT_TRUE(room.holds(room.widest_place()));
}

// A wall is missing on one side: places from which a level ray leaves through it are not enclosed.
TEST(RoomOfAMesh, BesideAHoleRaysDecide) {
    TriangleMesh mesh = shapes::box({-1, -1, 0}, {1, 1, 2}, false);
    std::erase_if(mesh.triangles, [&](const TriangleMesh::Triangle& t) {
        return std::all_of(t.begin(), t.end(), [&](std::int32_t i) {
            return mesh.vertices[static_cast<std::size_t>(i)].x() == 1;
        });
    });
    EXPECT_FALSE(room_of(mesh).holds({0, 0, 1}));
}

// Turned, so that no face lies along an axis and both ends are corners.
TEST(RoomOfAMesh, OfATurnedCubeHasItsVolume) {
    TriangleMesh mesh = shapes::box({-1, -1, -1}, {1, 1, 1});
    const Quaternion turn = Quaternion::FromTwoVectors(Vec3(1, 1, 1), Vec3(0, 0, 1)) *
                            Quaternion(Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()));
    for (Vec3& vertex : mesh.vertices) vertex = turn * vertex;
    const EnclosedRoom room = room_of(mesh);
    EXPECT_NEAR(room.volume(), 8, 1e-10);
}

// Smooth shapes with more heights than slices.
TEST(RoomOfAMesh, OfABallIsGoodToOneInTenThousand) {
    std::vector<shapes::Ring> rings;
    constexpr int steps = 200, sides = 100;
    double expected = 0;
    for (int i = 0; i <= steps; ++i) {
        const double angle = std::numbers::pi * i / steps;
        rings.push_back({i == 0 || i == steps ? 0 : std::sin(angle), -std::cos(angle)});
        if (i > 0)
            expected += shapes::frustum(rings[rings.size() - 2].radius, rings.back().radius,
                                        rings.back().z - rings[rings.size() - 2].z, sides);
    }
    const EnclosedRoom room = room_of(shapes::turned(rings, sides, false, false));
    EXPECT_NEAR(room.volume() / expected, 1, 1e-4);
    EXPECT_NEAR(room.volume_below(0) / expected, 0.5, 1e-3);
    EXPECT_NEAR(room.base(), -1, 1e-9);
}

TEST(RoomOfAMesh, APlateEnclosesNothing) {
    const EnclosedRoom flat = room_of(shapes::sheet(1, 4, [](double, double) { return 0.0; }));
    EXPECT_FALSE(flat.encloses_anything());
    EXPECT_FALSE(flat.holds({0, 0, 0}));
    EXPECT_EQ(flat.volume_below(1), 0);
    TriangleMesh wall;
    shapes::add_quad(wall, {0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1});
    EXPECT_FALSE(room_of(wall).encloses_anything());
}

}  // namespace
}  // namespace grainreel
