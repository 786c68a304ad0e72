// Tests of cells at walls: which part of them is inside, and that no mass is lost there.
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "engine/measure/fields/coarse_graining_observer.hpp"
#include "engine/scene/bed.hpp"
#include "tests/physics/fields/field_scene.hpp"

namespace grainreel {
namespace {

using Grid = FieldOutput::Grid;

Scene wedge(Grid grid) {
    Scene scene = field_box({4, 10, 12}, grid, 0.5, 0.37);
    scene.species.resize(2);
    scene.container.shape = Container::Shape::wedge;
    scene.container.half_angle = 0.5;
    scene.container.slant_height = 6;
    return scene;
}

Scene cylinder() {
    Scene scene = field_box({0, 8, 5}, Grid::xyz, 0.5, 0.37);
    scene.species.resize(2);
    scene.container.shape = Container::Shape::cylinder;
    return scene;
}

double free_volume(const Scene& scene) {
    const FieldGrid grid = make_field_grid(scene, scene.output.fields);
    double sum = 0;
    for (const double share : inside_shares(grid, scene)) {
        EXPECT_GE(share, 0);
        EXPECT_LE(share, 1);
        sum += share;
    }
    return sum * grid.cell_volume();
}

TEST(FieldCells, AddUpToTheContainer) {
    for (const Scene& scene : {wedge(Grid::yz), wedge(Grid::xyz), cylinder()})
        EXPECT_NEAR(free_volume(scene) / scene.container.volume(), 1, 1e-12);
}

// If only the floor is shaken, its lowest place is the end of the room.
TEST(FieldCells, ReachDownToWhereAMovingFloorGoes) {
    Scene scene = field_box({4, 10, 12}, Grid::yz, 0.5, 0.37);
    scene.drive.present = true;
    scene.drive.moves = Drive::Moves::floor;
    scene.drive.amplitude = 0.3;
    scene.drive.frequency = 1;
    EXPECT_NEAR(free_volume(scene), 4 * 10 * (12 + 0.3), 1e-9);
}

TEST(FieldCells, FreeVolumesAreThatOfTheContainer) {
    for (const Scene& scene : {wedge(Grid::yz), cylinder()}) {
        const CoarseGraining by(scene, 1);
        const FieldSet set = coarse_field_set(scene, by);
        ASSERT_EQ(set.fields.at(0).name, "free_volume");
        const FieldValues values = coarse_field_values(std::nullopt, by);
        const double sum = std::accumulate(values.at(0).begin(), values.at(0).end(), 0.0);
        EXPECT_NEAR(sum / scene.container.volume(), 1, 1e-12);
    }
}

TEST(FieldCells, BeginAtTheWallsAndReachAsFarBeyondAsTheKernel) {
    const Scene scene = field_box({4, 10, 12}, Grid::yz, 0.5, 0.37);
    const FieldGrid grid = make_field_grid(scene, scene.output.fields);
    const FieldKernel kernel(scene.output.fields.kernel, 0.5, 2);
    EXPECT_FALSE(grid.axes[0].resolved);
    EXPECT_EQ(grid.axes[0].cell, 4);
    for (const auto& [axis, low, high] : {std::tuple{grid.axes[1], -5.0, 5.0}, {grid.axes[2], 0.0, 12.0}}) {
        EXPECT_LE(axis.cell, 0.37);
        EXPECT_LE(axis.low, low - kernel.cutoff());
        const double first = (low - axis.low) / axis.cell, last = (high - axis.low) / axis.cell;
        EXPECT_NEAR(first, std::round(first), 1e-9);
        EXPECT_NEAR(last, std::round(last), 1e-9);
        EXPECT_GE(axis.low + static_cast<double>(axis.count) * axis.cell, high + kernel.cutoff() - 1e-9);
    }
}

TEST(FieldCells, ReachAsFarBeyondAsTheKernelOfTheLargestGrain) {
    Scene scene = field_box({4, 10, 12}, Grid::yz, 0.5, 0.37);
    scene.species[0].diameter.largest = 3;
    const FieldGrid grid = make_field_grid(scene, scene.output.fields);
    const double cutoff = FieldKernel(scene.output.fields.kernel, 1.5, 2).cutoff();
    EXPECT_LE(grid.axes[1].low, -5 - cutoff);
    EXPECT_GT(grid.axes[1].low, -5 - cutoff - 0.37);
}

// A grain outside has no density inside, however near to the wall it is; the whole kernel has its mass.
TEST(FieldCells, GrainsOutsideHaveNoDensity) {
    for (const Vec3& place : {Vec3(0, 5.3, 6), Vec3(0, 0, -0.2), Vec3(0, 0, 12.4), Vec3(0, 4.9, 1)}) {
        Scene scene = field_box({4, 10, 12}, Grid::yz, 0.5, 0.37);
        if (place.y() == 4.9) scene = wedge(Grid::yz);  // in the slant
        CoarseGraining by(scene, 1);
        by.add({{sphere(place, 0.5, 1, Vec3(0, 0, 1))}, {}}, 0);
        EXPECT_EQ(integral(by, by.mean().density), 0) << place.transpose();
    }
}

// Grains lie anywhere inside, many with kernels that reach beyond slants, corners and the round wall.
TEST(FieldCells, NoMassIsLostAtWalls) {
    for (const Scene& scene : {wedge(Grid::yz), wedge(Grid::xyz), cylinder()}) {
        const Container& container = scene.container;
        const bool round = container.shape == Container::Shape::cylinder;
        std::mt19937 random(2);
        std::uniform_real_distribution<double> any(-1, 1);
        FieldState state;
        double mass[2] = {0, 0}, volume[2] = {0, 0};
        while (state.grains.size() < 300) {
            const double half_depth = round ? container.half_width : container.depth / 2;
            const Vec3 place(half_depth * any(random), container.half_width * any(random),
                             0.5 * container.height * (1 + any(random)));
            if (std::abs(place.y()) > container.half_width_at(place.z())) continue;
            if (round && std::hypot(place.x(), place.y()) > container.half_width) continue;
            const std::int32_t species = state.grains.size() % 3 == 0;
            state.grains.push_back(
                sphere(place, 0.5 + 0.2 * any(random), species == 0 ? 2 : 3, Vec3::Zero(), species));
            mass[species] += state.grains.back().mass;
            volume[species] += state.grains.back().volume;
        }
        CoarseGraining by(scene, 1);
        by.add(state, 0);
        const CoarseFields fields = by.mean();
        EXPECT_NEAR(integral(by, fields.density) / (mass[0] + mass[1]), 1, 1e-10);
        for (std::size_t s = 0; s < 2; ++s)
            EXPECT_NEAR(integral(by, fields.solid_fraction[s]) / volume[s], 1, 1e-10);
    }
}

}  // namespace
}  // namespace grainreel
