// Tests of glued grains and of the tray in the picture.
#include <gtest/gtest.h>

#include "engine/state/glued_grains.hpp"
#include "render/picture/grains/spheres.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

FilmedScene rough(std::vector<std::string> faces) {
    FilmedScene scene = wedge();
    WallGrains layer;
    layer.species = 1;
    layer.faces = std::move(faces);
    layer.spacing = 0.01;
    scene.container.wall_grains = layer;
    return scene;
}

std::size_t seen_of(const FilmedScene& scene) {
    return GluedSpheres(scene).seen(view_of(scene), State()).size();
}

// Glued grains between the eye and the bed would hide the bed.
TEST(GluedSpheres, AreSeenWhereTheEyeLooksAtTheInnerSide) {
    const auto all = [](const FilmedScene& scene) {
        return glue_grains(scene, container_faces(scene.container, scene.drive)).size();
    };
    for (const char* face : {"left slant", "right slant", "left wall", "back", "floor"}) {
        const FilmedScene scene = rough({face});
        EXPECT_GT(all(scene), 10u);
        EXPECT_EQ(seen_of(scene), all(scene)) << face;
    }
    EXPECT_EQ(seen_of(rough({"front"})), 0u);
    EXPECT_EQ(seen_of(rough({"back", "front"})), seen_of(rough({"back"})));
}

TEST(GluedSpheres, MoveWithTheirWall) {
    for (const bool floor : {false, true}) {
        const FilmedScene scene = rough({floor ? "floor" : "back"});
        State frame;
        (floor ? frame.floor() : frame.container()).place = Vec3(0, 0, 0.013);
        const GluedSpheres spheres(scene);
        const auto before = spheres.seen(view_of(scene), State()), now = spheres.seen(view_of(scene), frame);
        ASSERT_EQ(now.size(), before.size());
        for (std::size_t k = 0; k < now.size(); ++k)
            EXPECT_LT((now[k].centre - before[k].centre - Vec3(0, 0, 0.013)).norm(), 1e-12);
    }
}

// The glued grains are in the picture, and do not have the colour of their species.
TEST(GluedSpheres, AreDrawn) {
    const FilmedScene scene = rough({"back"});
    FilmedScene plain = scene;
    plain.container.wall_grains.reset();
    Renderer with(scene, 1), without(plain, 1);
    const Picture a = with.draw(State(), "", 0), b = without.draw(State(), "", 0);
    const View view = with.view();
    std::size_t differ = 0, checked = 0;
    for (const GluedSpheres::Seen& one : GluedSpheres(scene).seen(view, State())) {
        const Eigen::Vector2d at = view.project(one.centre);
        const int x = view.port.x + static_cast<int>(at.x()), y = view.port.y + static_cast<int>(at.y());
        if (x < 0 || y < 0 || x >= a.width || y >= a.height) continue;
        ++checked;
        differ += difference(a, b, x, y) > 20;
    }
    EXPECT_GT(checked, 50u);
    EXPECT_GT(differ, checked * 9 / 10);
}

TEST(Framing, HasAllOfTheTray) {
    FilmedScene scene = wedge();
    scene.container.outlet = Outlet{Outlet::Shape::slot, 0.02, 0, 0.05};
    scene.container.tray = Tray{0.2, 0.1};
    const View view = view_of(scene);
    for (const double side : {-1.0, 1.0}) {
        const Eigen::Vector2d at = view.project(Vec3(0.02, side * 0.1, -0.2));
        EXPECT_GT(at.x(), 0);
        EXPECT_LT(at.x(), view.port.width);
        EXPECT_LT(at.y(), view.port.height);
    }
}

}  // namespace
}  // namespace grainreel::test
