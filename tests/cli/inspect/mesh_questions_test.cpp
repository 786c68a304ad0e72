// Tests of questions about moments of scenes with meshes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/mesh/surface.hpp"
#include "engine/questions/questions.hpp"
#include "engine/questions/ray.hpp"
#include "tests/cli/mesh_scene.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;

// A square of side 2 in the plane x = 0, which turns about the z axis.
Scene with_square() {
    TriangleMesh square{{{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}}, {{0, 1, 2}, {0, 2, 3}}};
    Scene scene;
    scene.container.shape = Container::Shape::none;
    scene.meshes.resize(1);
    scene.meshes[0].name = "vane";
    scene.meshes[0].surface.of = std::make_shared<const Surface>(square, MeshFacts{}, "square");
    return scene;
}

State with_vane_at(const Vec3& place, double angle) {
    State frame;
    frame.bodies.push_back(
        {place, Quaternion(Eigen::AngleAxisd(angle, Vec3(0, 0, 1))), {0, 0, 0}, {0, 0, 0}});
    return frame;
}

// The square has turned by 60 degrees and gone 5 along x: a ray along x through y = 0.2 meets it where x cos
// 60 + y sin 60 = 0 relative to it.
TEST(RayAndMesh, MeetWhereTheMeshIsNow) {
    const Scene scene = with_square();
    const State frame = with_vane_at({5, 0, 0}, std::numbers::pi / 3);
    const Ray ray{{-3, 0.2, 0.5}, {2, 0, 0}};
    const std::vector<MeshOnRay> found = meshes_on(ray, scene, frame, {});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].mesh, 0u);
    EXPECT_NEAR(ray.at(found[0].at).x(), 5 - 0.2 * std::tan(std::numbers::pi / 3), 1e-9);
    EXPECT_EQ(found[0].triangle, 1);  // above its diagonal
    EXPECT_TRUE(meshes_on({{-3, 0.2, 1.5}, {2, 0, 0}}, scene, frame, {}).empty());
}

TEST(RayAndMesh, WhatACutTakesAwayIsNotThere) {
    const Scene scene = with_square();
    const Ray ray{{-3, 0.2, 0.5}, {1, 0, 0}};
    EXPECT_EQ(meshes_on(ray, scene, with_vane_at({0, 0, 0}, 0), {{Vec3(1, 0, 0), -0.1}}).size(), 1u);
    EXPECT_TRUE(meshes_on(ray, scene, with_vane_at({0, 0, 0}, 0), {{Vec3(1, 0, 0), 0.1}}).empty());
}

TEST(WallNames, HaveTheMeshesBehindTheFaces) {
    Scene scene = with_square();
    scene.walls.resize(1);
    scene.walls[0].name = "plane";
    EXPECT_THAT(wall_names(scene), testing::ElementsAre("plane", "vane"));
    EXPECT_FALSE(mesh_of_wall(scene, -1));
    EXPECT_EQ(mesh_of_wall(scene, -2), 0u);
    EXPECT_FALSE(mesh_of_wall(scene, -3));
}

class InspectedMesh : public testing::Test {
  protected:
    void SetUp() override {
        write_mesh_scene(folder.path());
        const Ended run = run_program({"movie", "plate.toml", "--out", "run", "--no-film", "--no-report",
                                       "--set", "output.instruments=[\"walls\", \"wear\"]"},
                                      {.folder = folder.path()});
        ASSERT_EQ(run.status, 0) << run.err;
    }
    nlohmann::json answer(std::vector<std::string> words) const {
        words.insert(words.begin(), "inspect");
        words.push_back("--json");
        const Ended ended = run_program(words, {.folder = folder.path()});
        EXPECT_EQ(ended.status, 0) << ended.err;
        return nlohmann::json::parse(ended.out);
    }
    nlohmann::json tables(const std::vector<std::string>& words) const { return answer(words)["tables"]; }

    TemporaryFolder folder;
};

// The mesh turns at 30 rpm from 10 ms on, after a smooth start of 20 ms. It is as far as if it had turned at
// the full rate from 20 ms on.
TEST_F(InspectedMesh, TheOverviewSaysWhereBodiesAre) {
    const auto all = answer({"run"});
    const auto& bodies = all["tables"]["bodies"]["rows"];
    ASSERT_EQ(bodies.size(), 2u);
    EXPECT_EQ(bodies[0][0], "plate");
    EXPECT_EQ(bodies[0][1], 2);
    EXPECT_EQ(bodies[1][0], "paddle");
    EXPECT_NEAR(bodies[1][5].get<double>(), 360 * 0.5 * (all["moment"]["time"].get<double>() - 0.02), 1e-9);
    EXPECT_NEAR(bodies[1][7].get<double>(), std::numbers::pi, 1e-9);
}

// The ball rests on the plate, or comes back to it.
TEST_F(InspectedMesh, AMeshIsAWall) {
    const auto wall = tables({"run", "--wall", "plate"});
    ASSERT_TRUE(wall.contains("wall"));
    EXPECT_GE(wall["wall"]["rows"][0][0].get<int>(), 0);
}

TEST_F(InspectedMesh, ATrajectoryAloneHasTheMeshes) {
    std::filesystem::create_directory(folder / "alone");
    std::filesystem::copy(folder / "run" / "trajectory.nc", folder / "alone" / "t.nc");
    const auto bodies = tables({"alone/t.nc"})["bodies"]["rows"];
    ASSERT_EQ(bodies.size(), 2u);
    EXPECT_EQ(bodies[1][0], "paddle");
    EXPECT_EQ(bodies[1][1], 2);
    EXPECT_NEAR(bodies[1][5].get<double>(), tables({"run"})["bodies"]["rows"][1][5].get<double>(), 1e-6);
}

TEST_F(InspectedMesh, CountsAreThereOverTime) {
    const auto table = tables({"run", "--where", "z > 0 cm", "--over-time"})["over_time"]["rows"];
    ASSERT_GT(table.size(), 2u);
    for (const auto& row : table) {
        EXPECT_EQ(row[2], 1);  // the ball
        EXPECT_EQ(row[3], 1);
    }
}

}  // namespace
}  // namespace grainreel
