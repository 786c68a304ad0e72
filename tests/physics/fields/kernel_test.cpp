// Tests of the kernels by which fields are averaged.
#include "engine/measure/fields/field_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/fields/field_scene.hpp"

namespace grainreel {
namespace {

constexpr double kWidth = 0.7;

class Kernels : public ::testing::TestWithParam<FieldOutput::Kernel> {};

TEST_P(Kernels, TableIsWithinWhatItPromises) {
    const FieldKernel kernel(GetParam(), kWidth, 3);
    for (double q = 0; q < 0.9999; q += 0.000313)
        EXPECT_NEAR(kernel.at(std::pow(q * kernel.cutoff(), 2)), kernel_value(GetParam(), q), 2e-5) << q;
    EXPECT_EQ(kernel.at(0), 1);
    EXPECT_EQ(kernel.at(std::pow(1.0001 * kernel.cutoff(), 2)), 0);
}

// The line is compared with the mean over a thousand of its points.
TEST_P(Kernels, LineIsTheMeanOverItsPoints) {
    Scene scene = field_box({6, 6, 6}, FieldOutput::Grid::xyz, 0.5, 0.25);
    const FieldGrid grid = make_field_grid(scene, scene.output.fields);
    const FieldKernel kernel(GetParam(), 0.5, 3);
    const auto cells = static_cast<std::size_t>(grid.cells());
    Footprint footprint(grid, kernel);
    for (const Vec3& branch : {Vec3(0.3, 1, -0.5), Vec3(-1.5, 1.1, 1.2), Vec3(0, 0, -0.5)}) {
        const Vec3 begin(0.1, -0.7, 2.9);
        std::vector<double> mean(cells, 0), line(cells, 0);
        constexpr int points = 1000;
        for (int k = 0; k < points; ++k)
            for (const CellWeight& cell : footprint.of_point(begin + (k + 0.5) / points * branch))
                mean[static_cast<std::size_t>(cell.cell)] += cell.weight / points;
        for (const CellWeight& cell : footprint.of_line(begin, branch))
            line[static_cast<std::size_t>(cell.cell)] = cell.weight;
        const double peak = *std::max_element(mean.begin(), mean.end());
        double square = 0;
        for (std::size_t c = 0; c < cells; ++c) {
            square += std::pow(line[c] - mean[c], 2);
            EXPECT_NEAR(line[c], mean[c], 0.02 * peak);
        }
        EXPECT_LT(std::sqrt(square / static_cast<double>(cells)), 1e-3 * peak);
    }
}

// Through each plane across the line flows the part of the first kernel before the plane, less the part of
// the last kernel before it. Across the line the flows sum to nothing.
TEST_P(Kernels, AChangingLineCarriesTheOneKernelIntoTheOther) {
    for (const auto grid_of : {FieldOutput::Grid::xyz, FieldOutput::Grid::yz}) {
        Scene scene = field_box({8, 8, 8}, grid_of, 0.5, 0.125);
        scene.species[0].diameter.largest = 2;
        const FieldGrid grid = make_field_grid(scene, scene.output.fields);
        Footprint footprint(grid, FieldKernel(GetParam(), 0.5, grid.dimensions()));
        const Vec3 begin(0.1, -0.3, 3.2), branch(0.2, 0.4, 1.6);
        const GridAxis& z = grid.axes[2];
        const std::int64_t layer = grid.axes[0].count * grid.axes[1].count;
        std::vector<double> flow(static_cast<std::size_t>(z.count)), gain(flow);
        const auto at = [&](std::int64_t cell) { return static_cast<std::size_t>(cell / layer); };
        Vec3 sum = Vec3::Zero();
        for (const CellWay& cell : footprint.of_changing_line(begin, branch, 0.6, 1)) {
            flow[at(cell.cell)] += cell.way.z() * grid.cell_volume() / z.cell;
            sum += grid.cell_volume() * cell.way;
        }
        EXPECT_LT((sum - branch).norm(), 1e-12);
        for (const CellWeight& cell : footprint.of_point(begin, 0.6))
            gain[at(cell.cell)] += cell.weight * grid.cell_volume();
        for (const CellWeight& cell : footprint.of_point(begin + branch, 1))
            gain[at(cell.cell)] -= cell.weight * grid.cell_volume();
        double before = 0;
        for (std::size_t k = 0; k < flow.size(); ++k) {
            EXPECT_NEAR(flow[k], before + gain[k] / 2, 4e-3) << k;
            before += gain[k];
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Both, Kernels,
                         ::testing::Values(FieldOutput::Kernel::gaussian, FieldOutput::Kernel::lucy));

// The kernel is exp(-r2 / 2 w2) up to three widths.
TEST(GaussianKernel, HasItsWidthAndItsCutoff) {
    for (const int dimensions : {2, 3}) {
        const FieldKernel kernel(FieldOutput::Kernel::gaussian, kWidth, dimensions);
        for (const double widths : {0.5, 1.0, 2.0, 2.9})
            EXPECT_NEAR(kernel.at(std::pow(widths * kWidth, 2)), std::exp(-0.5 * widths * widths), 2e-5);
        EXPECT_NEAR(kernel.cutoff(), 3 * kWidth, 1e-12);
    }
}

// A point on the outer edge of the grid has half of its kernel beyond the edge, and that half is lost.
TEST(Footprints, WhatLiesBeyondTheGridIsNotMadeUpFor) {
    const Scene scene = field_box({6, 6, 6}, FieldOutput::Grid::yz, 0.5, 0.25);
    const FieldGrid grid = make_field_grid(scene, scene.output.fields);
    for (const FieldOutput::Kernel kind : {FieldOutput::Kernel::gaussian, FieldOutput::Kernel::lucy}) {
        Footprint footprint(grid, FieldKernel(kind, 0.5, 2));
        const auto all_of = [&](const std::span<const CellWeight> cells) {
            double sum = 0;
            for (const CellWeight& cell : cells) sum += cell.weight;
            return sum * grid.cell_volume();
        };
        const Vec3 edge(0, 0, grid.axes[2].low);
        EXPECT_NEAR(all_of(footprint.of_point(Vec3(0, 0, 3))), 1, 1e-12);
        EXPECT_NEAR(all_of(footprint.of_point(edge)), 0.5, 1e-12);
        EXPECT_NEAR(all_of(footprint.of_line(edge - Vec3(0, 0, 0.2), Vec3(0, 0, 0.4))), 0.5, 1e-12);
    }
}

TEST(LucyKernel, HasItsWidthAsStandardDeviationAlongEachAxis) {
    for (const int dimensions : {2, 3}) {
        const FieldKernel kernel(FieldOutput::Kernel::lucy, kWidth, dimensions);
        constexpr int points = 20000;
        double sum = 0, moment = 0;
        for (int k = 0; k < points; ++k) {
            const double q = (k + 0.5) / points;
            const double share = std::pow(q, dimensions - 1) * kernel_value(FieldOutput::Kernel::lucy, q);
            sum += share;
            moment += share * q * q;
        }
        EXPECT_NEAR(kernel.cutoff() * std::sqrt(moment / sum / dimensions), kWidth, 1e-6);
    }
}

}  // namespace
}  // namespace grainreel
