// Tests of vessels that hold their grains, and of vessels that do not.
#include "engine/mesh/room.hpp"
#include "engine/scene/free_space.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/mesh/load_mesh.hpp"
#include "tests/scene/meshes_by_hand.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

std::optional<Vec3> leak_in(const MeshByHand& mesh, double diameter = 0.002) {
    const MeshScenes files;
    LoadedMesh loaded = load_mesh(files.write("vessel.stl", mesh));
    const auto surface =
        std::make_shared<const Surface>(std::move(loaded.mesh), std::move(loaded.facts), "vessel");
    return leak_of(*surface, EnclosedRoom(surface), diameter);
}

void add(MeshByHand& mesh, const MeshByHand& more) {
    mesh.insert(mesh.end(), more.begin(), more.end());
}

// A cone of sheets with so many facets, from one radius and height to another.
MeshByHand cone(double low, double low_z, double high, double high_z, int facets = 24) {
    MeshByHand mesh;
    const auto at = [&](double r, double z, int k) {
        const double angle = 2 * pi * (k % facets) / facets;
        return Vec3(r * std::cos(angle), r * std::sin(angle), z);
    };
    for (int k = 0; k < facets; ++k)
        add_quad(mesh, at(low, low_z, k), at(low, low_z, k + 1), at(high, high_z, k + 1),
                 at(high, high_z, k));
    return mesh;
}

// A cup with thick walls: an outer and an inner box are joined at the rim, and a hole of so many m goes
// through its floor.
MeshByHand cup(double hole) {
    const double out = 0.05, in = 0.04, top = 0.08, floor = 0.01, h = 0.5 * hole;
    const auto ring = [](MeshByHand& mesh, double a, double az, double b, double bz) {
        const Vec3 corner[4] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
        for (int k = 0; k < 4; ++k) {
            const Vec3 p = corner[k], q = corner[(k + 1) % 4], u(0, 0, az), v(0, 0, bz);
            add_quad(mesh, a * p + u, a * q + u, b * q + v, b * p + v);
        }
    };
    MeshByHand mesh;
    ring(mesh, out, 0, out, top);
    ring(mesh, out, top, in, top);
    ring(mesh, in, top, in, floor);
    if (hole > 0) {
        ring(mesh, in, floor, h, floor);
        ring(mesh, h, floor, h, 0);
        ring(mesh, h, 0, out, 0);
    } else {
        add_quad(mesh, {-in, -in, floor}, {in, -in, floor}, {in, in, floor}, {-in, in, floor});
        add_quad(mesh, {-out, out, 0}, {out, out, 0}, {out, -out, 0}, {-out, -out, 0});
    }
    return mesh;
}

TEST(VesselLeak, VesselsHold) {
    EXPECT_FALSE(leak_in(box_of_sheets(0.1, 0.08)));
    EXPECT_FALSE(leak_in(box_of_sheets(0.1, 0.08, true)));
    EXPECT_FALSE(leak_in(cup(0)));
}

TEST(VesselLeak, HolesAreFoundInSheetsAndInThickWalls) {
    for (const double hole : {0.02, 0.004}) {
        const auto leak = leak_in(box_of_sheets(0.1, 0.08, false, hole));
        ASSERT_TRUE(leak) << hole;
        EXPECT_LT(std::abs(leak->z()), 0.01);
        EXPECT_LT(leak->head<2>().norm(), hole);
    }
    EXPECT_TRUE(leak_in(cup(0.01)));
    EXPECT_TRUE(leak_in(cone(0.01, 0, 0.05, 0.08)));
}

// No grain gets through these holes.
TEST(VesselLeak, HolesSmallerThanAGrainAreNone) {
    EXPECT_FALSE(leak_in(box_of_sheets(0.1, 0.08, false, 0.0015)));
    EXPECT_FALSE(leak_in(box_of_sheets(0.1, 0.08, false, 0.01), 0.03));
}

// A sheet in the middle of the room has open edges, which are a rim.
TEST(VesselLeak, SheetsInTheRoomAreNoHoles) {
    MeshByHand mesh = box_of_sheets(0.1, 0.08, true);
    MeshByHand lifter;
    add_quad(lifter, {-0.05, 0, 0}, {0.05, 0, 0}, {0.05, 0, 0.03}, {-0.05, 0, 0.03});
    add(mesh, lifter);
    EXPECT_FALSE(leak_in(mesh));
}

// Where a triangle's corner lies on another one's edge, the mesh has open edges but no hole.
TEST(VesselLeak, SeamsWhoseVerticesDoNotMeetAreNoHoles) {
    const double h = 0.05;
    MeshByHand mesh = box_of_sheets(2 * h, 0.08);
    mesh.pop_back(), mesh.pop_back();  // the floor
    add_quad(mesh, {-h, h, 0}, {0.013, h, 0}, {0.013, -h, 0}, {-h, -h, 0});
    add_quad(mesh, {0.013, h, 0}, {h, h, 0}, {h, 0.007, 0}, {0.013, 0.007, 0});
    add_quad(mesh, {0.013, 0.007, 0}, {h, 0.007, 0}, {h, -h, 0}, {0.013, -h, 0});
    EXPECT_FALSE(leak_in(mesh));
}

// The rim of a vessel that is cut obliquely is a rim too, and nothing is lost below its lowest place.
TEST(VesselLeak, ARimMayBeAslant) {
    MeshByHand mesh = box_of_sheets(0.1, 0.08);
    for (TriangleByHand& triangle : mesh)
        for (Vec3& v : triangle)
            if (v.z() > 0) v.z() += 0.3 * v.x();
    EXPECT_FALSE(leak_in(mesh));
}

// The hole is not above the middle, where it would make the vessel an open one.
TEST(VesselLeak, AClosedVesselMustBeClosedAbove) {
    MeshByHand mesh = box_of_sheets(0.1, 0.08, true);
    EXPECT_FALSE(leak_in(mesh));
    mesh.pop_back();  // half of the lid
    mesh.push_back({Vec3(-0.05, -0.05, 0.08), Vec3(0.05, 0.05, 0.08), Vec3(-0.03, 0.05, 0.08)});
    mesh.push_back({Vec3(-0.05, -0.05, 0.08), Vec3(-0.03, 0.05, 0.08), Vec3(-0.05, 0.03, 0.08)});
    EXPECT_TRUE(leak_in(mesh));
}

}  // namespace
}  // namespace grainreel
