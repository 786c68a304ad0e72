// Tests that those grains and triangles are listed that are found by looking at each one.
#include "engine/step/lists/mesh_near.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/step/grid/neighbours.hpp"
#include "tests/physics/step/mesh_world.hpp"

namespace grainreel {
namespace {

std::vector<std::int32_t> listed_in(const MeshLists& lists) {
    std::vector<std::int32_t> numbers;
    for (const NearTriangle& triangle : lists.triangles) numbers.push_back(triangle.number);
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

// The grain creeps, so that earlier finds are used again, and sometimes it jumps.
TEST(MeshLists, HoldAllTrianglesWithinReachWhereverTheGrainGoes) {
    const auto surface = surface_of(box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1), 9));
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> anywhere(-1.2, 1.2), little(-0.002, 0.002);
    const auto any_of = [&](auto& way) { return Vec3(way(random), way(random), way(random)); };
    MeshLists lists;
    Vec3 centre(0, 0, 0.9);
    for (int k = 0; k < 2000; ++k) {
        centre = k % 20 == 0 ? any_of(anywhere) : Vec3(centre + any_of(little));
        const double reach = k % 3 == 0 ? 0.2 : 0.21;
        std::vector<std::int32_t> wanted;
        surface->near(centre, reach, wanted);
        lists.clear();
        lists.add(7, 2, *surface, centre, reach);
        ASSERT_EQ(listed_in(lists), wanted) << k;
        ASSERT_EQ(lists.near.size(), wanted.empty() ? 0u : 1u);
        if (wanted.empty()) continue;
        const MeshNear& near = lists.near[0];
        EXPECT_GE(near.flat, 1);
        EXPECT_LE(near.flat, near.count);
    }
}

// The triangles of a box's side lie in one plane, and those around the corner in others.
TEST(MeshLists, FlatNeighboursStandBehindTheFirst) {
    const auto surface = surface_of(box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1), 4));
    MeshLists lists;
    lists.add(0, 0, *surface, Vec3(0.1, 0.15, 0.9), 0.12);
    ASSERT_EQ(lists.near.size(), 1u);
    EXPECT_GT(lists.near[0].stays, 0);
    EXPECT_EQ(lists.near[0].flat, 2);
    lists.clear();
    lists.add(0, 0, *surface, Vec3(0.95, 0.11, 0.9), 0.2);
    const MeshNear& near = lists.near[0];
    ASSERT_LT(near.flat, near.count);
    for (std::int32_t k = 0; k < near.flat; ++k)
        EXPECT_GT(surface->normal(lists.triangles[static_cast<std::size_t>(k)].number).x(), 0.99);
}

TEST(MeshSearch, ListsTheGrainsThatEachAloneWould) {
    std::vector<MeshWall> meshes(2);
    meshes[0].surface = surface_of(box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1), 6));
    meshes[1].surface = surface_of(tube_mesh(0.3, 1, 24, 5));
    meshes[1].body.velocity = Vec3(0.5, 0, 0);
    DrivePose pose;
    pose.time = 0.4;
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> anywhere(-1.1, 1.1), size(0.01, 0.05);
    Grains grains;
    std::vector<Vec3> places;
    for (int i = 0; i < 3000; ++i)
        places.push_back(Vec3(anywhere(random), anywhere(random), anywhere(random)));
    std::sort(places.begin(), places.end(), [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
    for (int i = 0; i < 3000; ++i) grains.add(i, 0, places[static_cast<std::size_t>(i)], size(random), 1);
    constexpr double kSkin = 0.01;
    std::vector<WallNeighbour> found;
    list_meshes(grains, meshes, pose, kSkin, 10, 2990, found);
    std::size_t k = 0;
    for (std::int32_t i = 10; i < 2990; ++i)
        for (std::int32_t m = 0; m < 2; ++m) {
            const MeshWall& mesh = meshes[static_cast<std::size_t>(m)];
            const Place& own = grains.place[static_cast<std::size_t>(i)];
            if (!mesh.surface->any_within(mesh.body.at(pose).at_rest(own.position), own.radius + kSkin))
                continue;
            ASSERT_LT(k, found.size());
            EXPECT_EQ(found[k].grain, i);
            EXPECT_EQ(found[k].face, m);
            ++k;
        }
    EXPECT_EQ(k, found.size());
    EXPECT_GT(k, 200u);
}

}  // namespace
}  // namespace grainreel
