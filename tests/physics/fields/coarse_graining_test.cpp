// Tests of fields of states with a known answer.
#include "engine/measure/fields/coarse_graining.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/physics/fields/field_scene.hpp"

namespace grainreel {
namespace {

using Grid = FieldOutput::Grid;
using Kernel = FieldOutput::Kernel;

struct Choice {
    Grid grid;
    Kernel kernel;
};

class Fields : public ::testing::TestWithParam<Choice> {
  protected:
    Scene box(const Vec3& size, double width, double cell) const {
        Scene scene = field_box(size, GetParam().grid, width, cell);
        scene.output.fields.kernel = GetParam().kernel;
        return scene;
    }
};

INSTANTIATE_TEST_SUITE_P(Each, Fields,
                         ::testing::Values(Choice{Grid::yz, Kernel::gaussian},
                                           Choice{Grid::xyz, Kernel::gaussian},
                                           Choice{Grid::yz, Kernel::lucy}, Choice{Grid::xyz, Kernel::lucy}));

// Whatever the kernel, the mean over the box is 1. With a kernel of a grain's width the single grains are
// hardly seen: the Gaussian of half a spacing leaves ripples of exp(-2 pi^2 / 4) = 0.7 % and their multiples.
TEST_P(Fields, CubicPackingOfMassOneHasDensityOne) {
    CoarseGraining by(box({5, 5, 5}, 0.5, 0.25), 1);
    by.add(cubic_packing(), 0);
    const CoarseFields fields = by.mean();
    EXPECT_NEAR(integral(by, fields.density) / 125, 1, 1e-10);
    EXPECT_NEAR(integral(by, fields.solid_fraction[0]) / 125, std::numbers::pi / 6, 1e-10);
    const auto& [x, y, z] = by.grid().axes;
    for (std::int64_t cell = 0; cell < by.grid().cells(); ++cell) {
        const std::int64_t i = cell % x.count, j = cell / x.count % y.count, k = cell / x.count / y.count;
        const Vec3 place(x.resolved ? x.middle(i) : 0, y.middle(j), z.middle(k) - 2.5);
        if (place.cwiseAbs().maxCoeff() < 0.9) {
            EXPECT_NEAR(fields.density[static_cast<std::size_t>(cell)], 1, 0.08) << place.transpose();
        }
    }
}

TEST_P(Fields, ShearedLatticeHasItsShearRate) {
    constexpr double rate = 3;
    FieldState state = cubic_packing();
    for (FieldGrain& grain : state.grains) grain.velocity = Vec3(0, rate * grain.position.z(), 0);
    CoarseGraining by(box({5, 5, 5}, 0.5, 0.25), 1);
    by.add(state, 0);
    const CoarseFields fields = by.mean();
    const auto& [x, y, z] = by.grid().axes;
    const std::int64_t i = x.count / 2, j = y.count / 2;
    const auto speed = [&](double height) {
        const auto k = static_cast<std::int64_t>((height - z.low) / z.cell);
        return fields.velocity[1][static_cast<std::size_t>(by.grid().index(i, j, k))];
    };
    // The difference is taken over two whole layers, so that both places lie alike in the lattice.
    EXPECT_NEAR((speed(3.6) - speed(1.6)) / 2, rate, 1e-3 * rate);
    EXPECT_NEAR(fields.velocity[0][static_cast<std::size_t>(by.grid().index(i, j, z.count / 2))], 0, 1e-12);
}

// Two streams flow through each other: the kinetic stress is rho u2 along them, and the temperature is u2 /
// 3.
TEST_P(Fields, StreamsThroughEachOtherAreHeat) {
    constexpr double speed = 2;
    FieldState state;
    for (int way : {-1, 1})
        state.grains.push_back(sphere(Vec3(0, 0, 2.5), 0.5, 6 / std::numbers::pi, way * Vec3(0, speed, 0)));
    CoarseGraining by(box({5, 5, 5}, 0.5, 0.5), 1);
    by.add(state, 0);
    const CoarseFields fields = by.mean();
    EXPECT_NEAR(padded_integral(by, fields.kinetic_stress[3]), 2 * speed * speed, 1e-10);
    EXPECT_NEAR(padded_integral(by, fields.kinetic_stress[0]), 0, 1e-12);
    const auto& axes = by.grid().axes;
    const auto middle =
        static_cast<std::size_t>(by.grid().index(axes[0].count / 2, axes[1].count / 2, axes[2].count / 2));
    EXPECT_NEAR(fields.temperature[middle], speed * speed / 3, 1e-12);
    EXPECT_NEAR(fields.velocity[1][middle], 0, 1e-12);
}

// A grain of 2 kg in one phase and one of 6 kg in the other are in the same place: V = (2 v1 + 6 v2) / 8, and
// each is at rest against its own phase. Two more in a phase of their own move against each other along a
// diagonal, so that m v v has entries off the diagonal as well.
TEST_P(Fields, WeighMassAcrossPhases) {
    const Scene scene = box({5, 5, 5}, 0.5, 0.5);
    CoarseGraining by(scene, 3);
    const Vec3 place(0, 0, 2.5), first(1, 2, 3), second(-1, 4, 0), along(0, 1, 2);
    const double per_kg = 6 / std::numbers::pi;
    for (int period = 0; period < 2; ++period) {
        by.add({{sphere(place, 0.5, per_kg, along), sphere(place, 0.5, 3 * per_kg, along / -3)}, {}}, 0);
        by.add({{sphere(place, 0.5, 2 * per_kg, first)}, {}}, 1);
        by.add({{sphere(place, 0.5, 6 * per_kg, second)}, {}}, 2);
    }
    const CoarseFields fields = by.mean();
    const auto& axes = by.grid().axes;
    const auto middle =
        static_cast<std::size_t>(by.grid().index(axes[0].count / 2, axes[1].count / 2, axes[2].count / 2));
    for (int a = 0; a < 3; ++a)
        EXPECT_NEAR(fields.velocity[static_cast<std::size_t>(a)][middle], (2 * first[a] + 6 * second[a]) / 12,
                    1e-12);
    EXPECT_NEAR(integral(by, fields.density), 12.0 / 3, 1e-10);
    constexpr int pairs[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
    double heat = 0;
    for (std::size_t c = 0; c < 6; ++c) {
        const double moved = along[pairs[c][0]] * along[pairs[c][1]] * (1 + 3.0 / 9);
        EXPECT_NEAR(padded_integral(by, fields.kinetic_stress[c]), moved / 3, 1e-10) << c;
        if (pairs[c][0] == pairs[c][1]) heat += moved;
    }
    EXPECT_NEAR(fields.temperature[middle], heat / (3 * 12), 1e-12);
}

// A motion that all grains make in every period at the same phase is no heat.
TEST_P(Fields, BouncingTogetherIsNoHeat) {
    for (const int phases : {2, 1}) {
        CoarseGraining by(box({5, 5, 5}, 0.5, 0.5), phases);
        for (int period = 0; period < 3; ++period)
            for (int half = 0; half < 2; ++half) {
                FieldState state = cubic_packing();
                for (FieldGrain& grain : state.grains) grain.velocity = Vec3(0, 0, half == 0 ? 1 : -1);
                by.add(state, half % phases);
            }
        const CoarseFields fields = by.mean();
        EXPECT_NEAR(padded_integral(by, fields.kinetic_stress[5]) / 125, phases == 2 ? 0 : 1, 1e-10);
        const auto& axes = by.grid().axes;
        const auto middle = static_cast<std::size_t>(
            by.grid().index(axes[0].count / 2, axes[1].count / 2, axes[2].count / 2));
        EXPECT_NEAR(fields.temperature[middle], phases == 2 ? 0 : 1.0 / 3, 1e-12);
    }
}

// The sum over the padded grid is the sum of f x b for any contacts (Goldhirsch 2010, eq. 35).
TEST_P(Fields, ContactStressKeepsTheVirial) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto vector = [&] { return Vec3(any(random), any(random), any(random)); };
    FieldState state;
    Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
    for (int c = 0; c < 50; ++c) {
        const double radius = 0.4 + 0.2 * c / 50, other = c % 3 == 0 ? radius : 0.8;
        state.contacts.push_back({2 * vector() + Vec3(0, 0, 2.5), 0.5 * vector(), vector(), radius, other});
        virial += state.contacts.back().force * state.contacts.back().branch.transpose();
    }
    Scene scene = box({5, 5, 5}, 0.5, 0.5);
    scene.species[0].diameter.largest = 1.6;
    CoarseGraining by(scene, 1);
    by.add(state, 0);
    const CoarseFields fields = by.mean();
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            EXPECT_NEAR(padded_integral(by, fields.contact_stress[static_cast<std::size_t>(3 * a + b)]),
                        virial(a, b), 1e-10);
}

// In a stack of spheres on a floor, the stress at each height is the weight above.
TEST_P(Fields, StackCarriesItsWeight) {
    constexpr int count = 8;
    constexpr double gravity = 10;
    FieldState state;
    for (int i = 0; i < count; ++i) {
        state.grains.push_back(sphere(Vec3(0, 0, i + 0.5), 0.5, 6 / std::numbers::pi));
        const Vec3 force(0, 0, -(count - i) * gravity);  // acts on the grain below
        state.contacts.push_back({state.grains.back().position, Vec3(0, 0, i > 0 ? -1 : -0.5), force});
    }
    CoarseGraining by(box({4, 4, 10}, 0.5, 0.25), 1);
    by.add(state, 0);
    const CoarseFields fields = by.mean();
    const auto& [x, y, z] = by.grid().axes;
    const std::int64_t layer = x.count * y.count;
    double above = 0;  // N
    for (std::int64_t k = z.count - 1; z.middle(k) > 1.8; --k) {
        double weight = 0, carried = 0;  // N, in the layer of cells
        for (std::int64_t cell = k * layer; cell < (k + 1) * layer; ++cell) {
            weight += gravity * by.grid().cell_volume() * fields.density[static_cast<std::size_t>(cell)];
            carried +=
                by.grid().cell_volume() / z.cell * fields.contact_stress[8][static_cast<std::size_t>(cell)];
        }
        EXPECT_NEAR(carried, above + weight / 2, 2e-3 * count * gravity) << z.middle(k);
        above += weight;
    }
    EXPECT_GT(above, 0.7 * count * gravity);
}

// The stress is also right if small and large spheres alternate, whose kernels are as wide as they are.
TEST_P(Fields, StackOfTwoSizesCarriesItsWeight) {
    constexpr int count = 6;
    constexpr double gravity = 10, small = 0.5, large = 1;
    FieldState state;
    double height = 0, above = 0, all = 0;
    for (int i = count - 1; i >= 0; --i)
        all += 4.0 / 3 * std::numbers::pi * std::pow(i % 2 ? large : small, 3);
    double rest = all;
    for (int i = 0; i < count; ++i) {
        const double radius = i % 2 ? large : small, other = i % 2 ? small : large;
        state.grains.push_back(sphere(Vec3(0, 0, height + radius), radius, 1));
        const double branch = i > 0 ? radius + other : radius;
        state.contacts.push_back({state.grains.back().position, Vec3(0, 0, -branch),
                                  Vec3(0, 0, -gravity * rest), radius, i > 0 ? other : radius});
        rest -= state.grains.back().mass;
        height += 2 * radius;
    }
    Scene scene = box({8, 8, 14}, 0.5, 0.25);
    scene.species[0].diameter.largest = 2 * large;
    CoarseGraining by(scene, 1);
    by.add(state, 0);
    const CoarseFields fields = by.mean();
    const auto& [x, y, z] = by.grid().axes;
    const std::int64_t layer = x.count * y.count;
    for (std::int64_t k = z.count - 1; z.middle(k) > 3.2; --k) {
        double weight = 0, carried = 0;  // N, in the layer of cells
        for (std::int64_t cell = k * layer; cell < (k + 1) * layer; ++cell) {
            weight += gravity * by.grid().cell_volume() * fields.density[static_cast<std::size_t>(cell)];
            carried +=
                by.grid().cell_volume() / z.cell * fields.contact_stress[8][static_cast<std::size_t>(cell)];
        }
        EXPECT_NEAR(carried, above + weight / 2, 3e-3 * gravity * all) << z.middle(k);
        above += weight;
    }
    EXPECT_GT(above, 0.6 * gravity * all);
}

// Small spheres fill a box, and a large one in the middle replaces those that it would meet. No place may be
// fuller than spheres can be packed, and the large sphere's own volume is counted where it lies.
TEST_P(Fields, SolidFractionAroundAnIntruderIsThatOfAPacking) {
    constexpr double intruder = 1.5,
                     spheres = std::numbers::pi / 6;  // spheres: solid fraction of a cubic packing
    const Vec3 middle(0, 0, 4.5);
    for (const bool periodic : {false, true}) {
        FieldState state;
        double volume = 0;
        for (int i = 0; i < 729; ++i) {
            const Vec3 place(i % 9 - 4, i / 9 % 9 - 4, i / 81 + 0.5);
            if ((place - middle).norm() > intruder + 0.5) state.grains.push_back(sphere(place, 0.5, 1));
        }
        state.grains.push_back(sphere(middle, intruder, 1));
        for (const FieldGrain& grain : state.grains) volume += grain.volume;
        Scene scene = box({9, 9, 9}, 0.5, 0.5);
        scene.species[0].diameter.largest = 2 * intruder;
        scene.container.periodic_depth = periodic;
        CoarseGraining by(scene, 1);
        by.add(state, 0);
        const CoarseFields fields = by.mean();
        EXPECT_NEAR(integral(by, fields.solid_fraction[0]) / volume, 1, 1e-10);
        for (std::size_t cell = 0; cell < fields.density.size(); ++cell) {
            if (by.shares()[cell] > 0) {
                EXPECT_LT(fields.solid_fraction[0][cell], std::numbers::pi / std::sqrt(18)) << cell;
            }
            EXPECT_EQ(std::isnan(fields.velocity[0][cell]),
                      by.shares()[cell] <= 0 || fields.density[cell] == 0);
        }
        const auto& axes = by.grid().axes;
        const auto centre = static_cast<std::size_t>(
            by.grid().index(axes[0].count / 2, axes[1].count / 2, axes[2].count / 2));
        EXPECT_GT(fields.solid_fraction[0][centre], 0.3 * spheres);
    }
}

// The wall's part of the stress reaches from the lowest centre down to the floor, and no further than the
// kernel.
TEST_P(Fields, WallTermIsSpreadAlongTheWayToTheWall) {
    FieldState state;
    state.contacts.push_back({Vec3(0, 0, 0.5), Vec3(0, 0, -0.5), Vec3(0, 0, -1)});
    CoarseGraining by(box({4, 4, 4}, 0.25, 0.125), 1);
    by.add(state, 0);
    const CoarseFields fields = by.mean();
    const auto& [x, y, z] = by.grid().axes;
    double moment = 0, sum = 0, lowest = 1e300;
    for (std::int64_t cell = 0; cell < by.grid().cells(); ++cell) {
        const double stress = fields.contact_stress[8][static_cast<std::size_t>(cell)];
        const double height = z.middle(cell / (x.count * y.count));
        if (stress > 0) lowest = std::min(lowest, height);
        moment += stress * height;
        sum += stress;
    }
    EXPECT_NEAR(moment / sum, 0.25, 1e-3) << "half of the way";
    EXPECT_LT(lowest, 0) << "the whole kernel, beyond the floor";
    EXPECT_GE(lowest, z.low);
}

TEST(FieldsInXyz, PeriodicDepthHasNoSeam) {
    Scene scene = field_box({4, 4, 4}, Grid::xyz, 0.5, 0.5);
    scene.container.periodic_depth = true;
    const auto of = [&](double x) {
        FieldState state;
        state.grains.push_back(sphere(Vec3(x, 0, 2), 0.5, 6 / std::numbers::pi));
        state.contacts.push_back({Vec3(x, 0, 2), Vec3(1, 0, 0), Vec3(1, 0, 0)});
        CoarseGraining by(scene, 1);
        by.add(state, 0);
        EXPECT_NEAR(padded_integral(by, by.mean().contact_stress[0]), 1, 1e-12) << x;
        return std::pair{by.mean(), by.grid()};
    };
    const auto [at_seam, grid] = of(-2);
    const auto [in_middle, same] = of(0);
    const std::int64_t half = grid.axes[0].count / 2;
    for (std::int64_t cell = 0; cell < grid.cells(); ++cell) {
        const std::int64_t i = cell % grid.axes[0].count, moved = i < half ? cell + half : cell - half;
        EXPECT_NEAR(at_seam.density[static_cast<std::size_t>(cell)],
                    in_middle.density[static_cast<std::size_t>(moved)], 1e-12);
        EXPECT_NEAR(at_seam.contact_stress[0][static_cast<std::size_t>(cell)],
                    in_middle.contact_stress[0][static_cast<std::size_t>(moved)], 1e-12);
    }
}

TEST(FieldsInXyz, WhereNobodyIsThereIsNoVelocity) {
    CoarseGraining by(field_box({4, 4, 8}, Grid::xyz, 0.5, 0.5), 1);
    FieldState state;
    state.grains.push_back(sphere(Vec3(0, 0, 0.5), 0.5, 1, Vec3(1, 0, 0)));
    by.add(state, 0);
    const CoarseFields fields = by.mean();
    for (std::size_t cell = 0; cell < fields.density.size(); ++cell) {
        EXPECT_EQ(std::isnan(fields.velocity[0][cell]), std::isnan(fields.temperature[cell]));
        EXPECT_EQ(std::isnan(fields.velocity[0][cell]), fields.density[cell] == 0) << cell;
    }
}

}  // namespace
}  // namespace grainreel
