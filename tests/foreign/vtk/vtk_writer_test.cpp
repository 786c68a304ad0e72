// Tests of VTK files that are written: they have the same bytes on any number of threads, and forces that add
// up.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/files/frames/writers/vtk_file.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {
namespace {

// Numbers without a pattern, enough for several blocks of 256 KiB.
std::vector<double> many_numbers(std::size_t count) {
    std::vector<double> numbers(count);
    std::uint64_t state = 1;
    for (double& number : numbers) {
        state = state * 6364136223846793005U + 1442695040888963407U;
        number = static_cast<double>(state >> 11);
    }
    return numbers;
}

TEST(VtkWriter, BytesDoNotDependOnThreads) {
    constexpr std::size_t points = 40000;
    VtkPolyData data;
    data.points = many_numbers(3 * points);
    for (std::size_t i = 0; i < points; ++i) data.connectivity.push_back(static_cast<std::int64_t>(i));
    data.point_data = {VtkList::doubles("radius", many_numbers(points))};
    data.facts.words = {{"species", {"small", "big"}}};
    const std::string one = vtk_bytes(data, 1);
    EXPECT_GT(one.size(), points * 8);
    for (const int threads : {2, 3, 7}) EXPECT_EQ(vtk_bytes(data, threads), one) << threads;

    VtkImage image;
    image.cells = {50, 40, 20};
    image.cell_data = {VtkList::doubles("velocity", many_numbers(3 * points), 3)};
    EXPECT_EQ(vtk_bytes(image, 5), vtk_bytes(image, 1));
}

TEST(VtkWriter, WordsAreTheirBytesAndAZero) {
    VtkPolyData data;
    data.facts.words = {{"species", {"a", "bc"}}};
    EXPECT_NE(vtk_bytes(data).find("NumberOfTuples=\"2\" format=\"ascii\">97 0 98 99 0 </Array>"),
              std::string::npos);
}

// Grain 3 lies on a wall at z = 0 and carries grain 7, which stands aside by an angle of 30 degrees.
struct Pile {
    State frame;
    std::vector<SavedContact> contacts;
    StoredWorld world;

    Pile() {
        frame.id = {3, 7};
        frame.species = {0, 0};
        frame.radius = {0.01, 0.02};
        const double way = 0.03;
        frame.position = {Vec3(0, 0, 0.01), Vec3(0.5 * way, 0, 0.01 + std::sqrt(0.75) * way)};
        frame.velocity = frame.spin = {Vec3(0, 0, 0), Vec3(0, 0, 0)};
        contacts = {{3, 7, 2.0, Vec3(0, 0.5, 0), Vec3(0.005, 0, 0.0186), -1},
                    {3, -1, 4.0, Vec3(0.25, 0, 0), Vec3(0, 0, 0), -1}};
    }
};

TEST(VtkWriter, ForcesOnGrainsAreTheSumsOfTheirContacts) {
    const Pile pile;
    const std::vector<Vec3> forces = forces_on_grains(pile.frame, pile.contacts, pile.world);
    const Vec3 between(2 * 0.5, 0.5, 2 * std::sqrt(0.75));  // on grain 7
    const Vec3 wall(0.25, 0, -4);                           // on the wall
    EXPECT_NEAR((forces[1] - between).norm(), 0, 1e-12);
    EXPECT_NEAR((forces[0] + between + wall).norm(), 0, 1e-12);
}

TEST(VtkWriter, LinesToWallsEndWhereTheyTouch) {
    const Pile pile;
    const VtkPolyData lines = contact_lines(pile.frame, pile.contacts, pile.world);
    ASSERT_EQ(lines.points.size(), 12U);
    EXPECT_EQ(lines.connectivity, (std::vector<std::int64_t>{0, 1, 2, 3}));
    const std::vector<double> wall(lines.points.begin() + 6, lines.points.end());
    EXPECT_EQ(wall, (std::vector<double>{0, 0, 0.01, 0, 0, 0}));
}

// The depth is 0.1 m along x: two grains at its ends touch across the edge.
TEST(VtkWriter, LinesAcrossAPeriodicEdgeAreShort) {
    Pile pile;
    pile.world.cell.emplace();
    pile.world.cell->edges[0] = Vec3(0.1, 0, 0);
    pile.world.cell->periodic = {true, false, false};
    pile.frame.position = {Vec3(-0.04, 0, 0), Vec3(0.045, 0, 0)};
    pile.contacts.resize(1);
    const VtkPolyData lines = contact_lines(pile.frame, pile.contacts, pile.world);
    EXPECT_NEAR(lines.points[3], -0.055, 1e-15);
    const std::vector<Vec3> forces = forces_on_grains(pile.frame, pile.contacts, pile.world);
    EXPECT_NEAR((forces[1] - Vec3(-2, 0.5, 0)).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace grainreel
