// Tests of walls as flat pieces in space.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/state/pose.hpp"
#include "render/page/bed/slabs.hpp"
#include "render/picture/container/container_drawing.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

FilmedScene with(Container::Shape shape) {
    FilmedScene scene;
    scene.container.shape = shape;
    scene.container.half_width = 0.05;
    scene.container.depth = 0.03;
    scene.container.height = 0.1;
    if (shape == Container::Shape::wedge) {
        scene.container.half_angle = std::numbers::pi / 6;
        scene.container.slant_height = 0.04;
    }
    return scene;
}

Vec3 normal_of(const std::vector<Vec3>& corners) {
    return (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
}

void expect_flat(const Slab& slab) {
    const Vec3 normal = normal_of(slab.inner);
    for (const Vec3& corner : slab.inner) EXPECT_NEAR(normal.dot(corner - slab.inner[0]), 0, 1e-12);
}

TEST(Slabs, OfAWedgeEnclosesTheRoomThatTheGrainsHave) {
    const FilmedScene scene = with(Container::Shape::wedge);
    const std::vector<Slab> slabs = slabs_of(scene);
    EXPECT_EQ(slabs.size(), 8u);  // two walls of two parts each, floor, lid, two panes
    for (const Slab& slab : slabs) {
        expect_flat(slab);
        EXPECT_TRUE(slab.outer.empty() || slab.outer.size() == slab.inner.size());
        // A point inside is on the inner side of each piece, by the half-width at its height and half the
        // depth.
        const Vec3 inside(0, 0, 0.05);
        const Vec3 away =
            slab.outer.empty() ? Vec3(slab.inner[0].x(), 0, 0) : Vec3(slab.outer[0] - slab.inner[0]);
        Vec3 normal = normal_of(slab.inner);
        if (normal.dot(away) < 0) normal = -normal;
        EXPECT_LT(normal.dot(inside - slab.inner[0]), 0);
    }
    const Slab& slanted = slabs.front();
    for (const Vec3& corner : slanted.inner)
        EXPECT_NEAR(std::abs(corner.y()), scene.container.half_width_at(corner.z()), 1e-12);
    EXPECT_NEAR(std::abs(normal_of(slanted.inner).z()), std::sin(std::numbers::pi / 6), 1e-12);
}

TEST(Slabs, OfACylinderIsARoundWallWithoutSeams) {
    const FilmedScene scene = with(Container::Shape::cylinder);
    double turned = 0;
    for (const Slab& slab : slabs_of(scene)) {
        expect_flat(slab);
        if (slab.seams.empty()) continue;  // floor and lid
        const Vec3 &a = slab.inner[0], &b = slab.inner[3];
        EXPECT_NEAR(std::hypot(a.x(), a.y()), scene.container.half_width, 1e-12);
        EXPECT_NEAR(std::hypot(slab.outer[0].x(), slab.outer[0].y()),
                    scene.container.half_width + drawn_thickness(scene.container), 1e-12);
        turned += std::remainder(std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x()), 2 * std::numbers::pi);
    }
    EXPECT_NEAR(turned, 2 * std::numbers::pi, 1e-9);
}

TEST(Slabs, AFloorWithAnOutletIsThereUntilItOpens) {
    FilmedScene scene = with(Container::Shape::box);
    scene.container.outlet = Outlet{Outlet::Shape::slot, 0.01, 2.5, 0.1};
    int before = 0, after = 0;
    for (const Slab& slab : slabs_of(scene)) {
        if (slab.body != kFloorBody) continue;
        before += slab.until == 2.5 && !slab.from;
        if (slab.from != 2.5) continue;
        ++after;
        for (const Vec3& corner : slab.inner) EXPECT_GE(std::abs(corner.y()), 0.01 - 1e-12);
    }
    EXPECT_EQ(before, 1);
    EXPECT_EQ(after, 2);
}

TEST(Slabs, ATrayStandsStillBelow) {
    FilmedScene scene = with(Container::Shape::box);
    scene.container.outlet = Outlet{Outlet::Shape::slot, 0.01, 0, 0.1};
    scene.container.tray = Tray{0.07, 0.08};
    double lowest = 0;
    int pieces = 0;
    for (const Slab& slab : slabs_of(scene)) {
        if (slab.body != kTrayBody) continue;
        ++pieces;
        for (const Vec3& corner : slab.inner) lowest = std::min(lowest, corner.z());
    }
    EXPECT_GE(pieces, 3);  // a floor and two walls at least
    EXPECT_NEAR(lowest, -0.07, 1e-12);
}

TEST(Slabs, PlanesHaveBodiesOfTheirOwn) {
    FilmedScene scene = with(Container::Shape::box);
    scene.walls = {{"shelf", {0, 0, 0.05}, {0, 0, 1}, {0, 0, 0}, false}};
    const Slab plane = slabs_of(scene).back();
    EXPECT_EQ(plane.body, kFirstPlaneBody);
    EXPECT_TRUE(plane.outer.empty());
    for (const Vec3& corner : plane.inner) EXPECT_NEAR(corner.z(), 0.05, 1e-12);
}

TEST(Slabs, TheBoxHasAllOfThem) {
    const FilmedScene scene = with(Container::Shape::box);
    const std::vector<Slab> slabs = slabs_of(scene);
    const Extent box = box_of(slabs, scene);
    const double thickness = drawn_thickness(scene.container);
    EXPECT_NEAR(box.high.y(), 0.05 + thickness, 1e-12);
    EXPECT_NEAR(box.high.z(), 0.1 + thickness, 1e-12);
    EXPECT_NEAR(box.low.x(), -0.015, 1e-12);
    EXPECT_LT(box.low.z(), 0);
}

// A box that is turned by a quarter about its middle is as wide as it was high.
TEST(Slabs, TheBoxHasThemWhereTheyAreTurned) {
    const FilmedScene scene = with(Container::Shape::box);
    const std::vector<Slab> slabs = slabs_of(scene);
    Extent box = box_of(slabs, scene);
    const Extent rest = box;
    take_turned(box, slabs, {State()});
    EXPECT_EQ(box.low, rest.low);
    EXPECT_EQ(box.high, rest.high);
    State turned;
    for (BodyPose& pose : turned.bodies) {
        pose.rotation = Quaternion(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3(1, 0, 0)));
        pose.place = Vec3(0, 0.05, 0.05);  // y and z become 0.05 - z and 0.05 + y
    }
    take_turned(box, slabs, {turned});
    EXPECT_NEAR(box.low.y(), std::min(rest.low.y(), 0.05 - rest.high.z()), 1e-12);
    EXPECT_NEAR(box.high.y(), std::max(rest.high.y(), 0.05 - rest.low.z()), 1e-12);
    EXPECT_NEAR(box.low.z(), std::min(rest.low.z(), 0.05 + rest.low.y()), 1e-12);
    EXPECT_NEAR(box.high.z(), std::max(rest.high.z(), 0.05 + rest.high.y()), 1e-12);
}

}  // namespace
}  // namespace grainreel
