// Tests of boxes that grains leave into or out of: where grains fade, and what the camera frames.
#include <gtest/gtest.h>

#include <memory>

#include "engine/mesh/surface.hpp"
#include "render/picture/camera/framing.hpp"
#include "render/picture/container/container_drawing.hpp"
#include "render/picture/mesh/scene_meshes.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

// A funnel of one plate whose lowest point is at z = 0.
FilmedScene with_exit(const ExitBox& box) {
    FilmedScene scene = wedge();
    scene.container.shape = Container::Shape::none;
    scene.drive.present = false;
    TriangleMesh plate{{{-0.05, -0.05, 0}, {0.05, -0.05, 0}, {0, 0.05, 0.2}}, {{0, 1, 2}}};
    SceneMesh& mesh = scene.meshes.emplace_back();
    mesh.name = "plate";
    mesh.low = {-0.05, -0.05, 0}, mesh.high = {0.05, 0.05, 0.2};
    mesh.surface.of = std::make_shared<const Surface>(plate, MeshFacts{}, "plate");
    scene.exits = {box};
    scene.film.camera.elevation = 0;
    return scene;
}

std::vector<std::uint32_t> fade_of(const FilmedScene& scene) {
    return exit_fade(scene, view_of(scene), scene.film.height, mesh_reach(scene));
}

// For the picture it is the same whether grains enter a box 0.05 m below everything or leave one that ends
// there.
TEST(ExitLevel, IsTheTopOfABoxOrTheFloorOfOneAroundEverything) {
    const FilmedScene below = with_exit({{-1, -1, -0.3}, {1, 1, -0.05}, false});
    const FilmedScene around = with_exit({{-1, -1, -0.05}, {1, 1, 1}, true});
    EXPECT_EQ(exit_level(below), -0.05);
    EXPECT_EQ(exit_level(around), -0.05);
    EXPECT_EQ(exit_level(wedge()), std::nullopt);
    const std::vector<std::uint32_t> rows = fade_of(below);
    ASSERT_EQ(rows.size(), 360u);
    EXPECT_EQ(rows.front(), 255u);
    EXPECT_EQ(rows.back(), 0u);
    EXPECT_EQ(fade_of(around), rows);
    EXPECT_EQ(framing_points(around), framing_points(below));
}

// A mesh that the drive moves 20 mm up and down reaches to -20 mm, and grains fade in the lower half of the
// way from there to the exit: from -35 mm on. If it stands, they fade from -25 mm on.
TEST(ExitLevel, LeavesRoomForTheStrokeOfAMesh) {
    FilmedScene scene = with_exit({{-1, -1, -0.3}, {1, 1, -0.05}, false});
    scene.drive = {true, 10, 0.02};
    const auto faded_at = [&](double z) {
        return fade_of(scene).at(static_cast<std::size_t>(view_of(scene).project({0, 0, z}).y())) < 255;
    };
    for (const bool driven : {false, true}) {
        scene.meshes[0].driven = driven;
        const double begins = driven ? -0.035 : -0.025;
        EXPECT_FALSE(faded_at(begins + 0.003)) << driven;
        EXPECT_TRUE(faded_at(begins - 0.003)) << driven;
    }
}

// With both, the one that grains meet first on the way down counts.
TEST(ExitLevel, IsTheHighestOfSeveral) {
    FilmedScene scene = with_exit({{-1, -1, -0.3}, {1, 1, -0.1}, false});
    scene.exits.push_back({{-1, -1, -0.06}, {1, 1, 1}, true});
    EXPECT_EQ(exit_level(scene), -0.06);
}

}  // namespace
}  // namespace grainreel::test
