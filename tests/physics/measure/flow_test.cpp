// Tests of circulation, stream function and drift on fields with known rotations and grains with known
// displacements.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "engine/measure/flow/drift.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

// Cells have the width a and the height b. u = (right, up) at their middles.
VelocityGrid field(std::size_t across, std::size_t high, double a, double b,
                   const std::function<std::pair<double, double>(double y, double z)>& u) {
    VelocityGrid grid{across, high, -0.5 * a * static_cast<double>(across), 0, a, b, {}, {}, {}};
    for (std::size_t k = 0; k < high; ++k) {
        for (std::size_t j = 0; j < across; ++j) {
            const auto [right, up] = u(grid.y(j), grid.z(k));
            grid.right.push_back(right);
            grid.up.push_back(up);
            grid.weight.push_back(3);
        }
    }
    return grid;
}

constexpr double kSpin = 0.7;
std::pair<double, double> rotation(double y, double z) {
    return {-kSpin * (z - 2), kSpin * (y + 1)};
}

// The circulation is 2 w times the area, whatever the shape of the filled cells and the middle of the
// rotation.
TEST(Circulation, OfARigidRotationIsTwiceItsRateTimesTheArea) {
    VelocityGrid grid = field(9, 7, 0.5, 0.3, rotation);
    Circulation all = circulation(grid, -10, 10);
    EXPECT_NEAR(all.area, 8 * 0.5 * 6 * 0.3, 1e-12);
    EXPECT_NEAR(all.edge, 2 * (8 * 0.5 + 6 * 0.3), 1e-12);
    EXPECT_NEAR(all.along, 2 * kSpin * all.area, 1e-12);
    for (const std::size_t cell : {0u, 1u, 30u, 8u}) grid.weight[cell] = 0;  // two corners, and a hole
    grid.up[30] = grid.right[30] = 1e9;
    all = circulation(grid, -10, 10);
    EXPECT_NEAR(all.area, (8 * 6 - 2 - 1 - 4) * 0.5 * 0.3, 1e-12);
    EXPECT_NEAR(all.along, 2 * kSpin * all.area, 1e-12);
    EXPECT_NEAR(all.speed(), all.along / all.edge, 1e-12);
}

TEST(Circulation, OfAHalfEndsInTheMiddle) {
    const Circulation half = circulation(field(9, 7, 0.5, 0.3, rotation), -10, 0);
    EXPECT_NEAR(half.area, 4 * 0.5 * 6 * 0.3, 1e-12);
    EXPECT_NEAR(half.along, 2 * kSpin * half.area, 1e-12);
}

TEST(Circulation, OfAFlowThatDoesNotTurnIsZero) {
    const auto saddle = [](double y, double z) { return std::pair{y + 3, 2 - z}; };
    EXPECT_NEAR(circulation(field(9, 7, 0.5, 0.3, saddle), -10, 10).along, 0, 1e-12);
    EXPECT_TRUE(std::isnan(circulation(field(1, 7, 0.5, 0.3, saddle), -10, 10).speed()));
}

// Two rolls go up in the middle: psi = -sin(2 pi y / W) sin(pi z / H). The mean of up = -d psi / dy over a
// cell is the difference of psi between its sides divided by its width.
constexpr double kWidth = 4, kHeight = 3;
double two_rolls(double y, double z) {
    return -std::sin(2 * pi * y / kWidth) * std::sin(pi * z / kHeight);
}
VelocityGrid rolls(double offset) {
    constexpr double a = kWidth / 8;
    return field(8, 9, a, kHeight / 9, [&](double y, double z) {
        return std::pair{0.0, offset - (two_rolls(y + a / 2, z) - two_rolls(y - a / 2, z)) / a};
    });
}

TEST(StreamFunction, IsWhatTheFlowWasMadeFrom) {
    for (const double offset : {0.0, 0.4}) {  // a flow that goes up everywhere is subtracted
        const VelocityGrid grid = rolls(offset);
        const std::vector<double> psi = stream_function(grid);
        for (std::size_t k = 0; k < grid.high; ++k)
            for (std::size_t j = 0; j < grid.across; ++j)
                EXPECT_NEAR(psi[grid.index(j, k)], two_rolls(grid.y(j) + 0.5 * grid.width, grid.z(k)), 1e-12);
    }
}

// Two filled cells in a row have the weights 1 and 3 and flows 3 up and 1 down: as much goes up as down.
TEST(StreamFunction, WeighsCellsByWhatIsInThem) {
    VelocityGrid grid = field(2, 1, 0.5, 1, [](double y, double) {
        return std::pair{0.0, y < 0 ? 3.0 : -1.0};
    });
    grid.weight = {1, 3};
    const std::vector<double> psi = stream_function(grid);
    EXPECT_NEAR(psi[0], -(1.0 / 2) * 3 * 0.5, 1e-12);
    EXPECT_NEAR(psi[1], 0, 1e-12);
}

TEST(StreamFunction, HasItsExtremaInTheMiddleOfTheRolls) {
    const VelocityGrid grid = rolls(0);
    const std::vector<double> psi = stream_function(grid);
    const RollCentre left = roll_centre(grid, psi, -2, 0), right = roll_centre(grid, psi, 0, 2);
    EXPECT_NEAR(left.y, -1, 1e-12);
    EXPECT_NEAR(left.z, 1.5, 1e-12);
    EXPECT_NEAR(left.psi, 1, 1e-12);  // counter-clockwise
    EXPECT_NEAR(right.y, 1, 1e-12);
    EXPECT_NEAR(right.psi, -1, 1e-12);
}

TEST(StreamFunction, OfNothingHasNoRoll) {
    VelocityGrid grid = rolls(0);
    grid.weight.assign(grid.weight.size(), 0);
    EXPECT_TRUE(std::isnan(roll_centre(grid, stream_function(grid), -2, 2).y));
}

// A box full of grains of diameter 1, one in the middle of each cell of two diameters.
struct Bed {
    Scene scene;
    Grains grains;

    Bed() {
        scene.container.shape = Container::Shape::box;
        scene.container.half_width = 11;
        scene.container.depth = 2;
        scene.container.height = 12;
        scene.species.resize(1);
        scene.species[0].count = 66;
        scene.species[0].diameter.mean = 1;
        for (int k = 0; k < 6; ++k)
            for (int j = 0; j < 11; ++j)
                grains.add(static_cast<std::int32_t>(grains.size()), 0, {0, 2 * j - 10.0, 2 * k + 1.0}, 0.5,
                           1);
    }
    // Moves each grain by a small displacement u a period for four periods, half of it before and half after
    // its place.
    void drift(const std::function<std::pair<double, double>(double y, double z)>& u, int half) {
        for (std::size_t i = 0; i < grains.size(); ++i) {
            const double y = 2.0 * (grains.id[i] % 11) - 10, z = 2.0 * (grains.id[i] / 11) + 1;
            const auto [right, up] = u(y, z);
            grains.place[i].position = Vec3(0, y + half * 2 * right, z + half * 2 * up);
        }
    }
};

// Both halves turn about their own middles with the rate w: up in the middle of the box where w > 0. Only
// squares of the halves' own cells count. These cells begin and end at the middle cell.
std::function<std::pair<double, double>(double, double)> two_wheels(double w) {
    return [w](double y, double z) {
        const double sense = y < 0 ? w : -w;
        if (y == 0) return std::pair{0.0, 5 * w};
        return std::pair{-sense * (z - 6), sense * (y - (y < 0 ? -5 : 5))};
    };
}

TEST(Drift, OfTwoWheelsHasTheirCirculation) {
    Bed bed;
    Drift drift(bed.scene);
    const double rates[] = {1e-3, 2e-3, 4e-3, 3e-3};
    for (int window = 0; window < 4; ++window) {
        const auto u = two_wheels(rates[window]);
        bed.drift(u, -1);
        drift.note(100 * window, bed.grains,
                   {});  // this is not the end of the window before, so the drift begins anew
        EXPECT_TRUE(std::isnan(drift.roll(Side::left).mean));
        bed.drift(u, 1);
        drift.note(100 * window + 4, bed.grains, {});
        // Squares of the half reach from y = -10 to 0 and from z = 1 to 11. At y = 0 the flow has the upward
        // part of the wheel. Its part to the right is 0 in place of -w (z - 6), which sums to nothing there.
        const double area = 10 * 10, edge = 2 * (10 + 10);
        const double wheel = 2 * rates[window] * area / edge;
        const double missing = rates[window] * 1 * (5 + 5) / edge;  // half a cell at the lower and upper end
        EXPECT_NEAR(drift.roll(Side::left).mean, wheel - missing, 1e-12);
        EXPECT_NEAR(drift.roll(Side::right).mean, wheel - missing, 1e-12);
        EXPECT_TRUE(std::isnan(drift.roll(Side::left).error));
        EXPECT_NEAR(drift.centre(Side::left).y, -5, 1e-12);
        EXPECT_NEAR(drift.centre(Side::right).y, 5, 1e-12);
    }
}

// The middle third ends at 11 / 3. Grains rise whose displacements have their middle there: those at -2, 0
// and 2. The others do not: neither those at -4, nor those that come from 4.6 to 3.
TEST(Drift, GoesByTheMiddleOfAWay) {
    Bed bed;
    Drift drift(bed.scene);
    for (const int window : {0, 1}) {
        for (std::size_t i = 0; i < bed.grains.size(); ++i) {
            Vec3& place = bed.grains.place[i].position;
            const int column = bed.grains.id[i] % 11;
            if (column >= 4 && column <= 6) place.z() += 4e-3 * window;
            if (column == 7) place.y() = window == 0 ? 4.6 : 3;
        }
        drift.note(4 * window, bed.grains, {});
    }
    EXPECT_NEAR(drift.rise(Drift::in_middle).mean, 1e-3 * (1 - 3.0 / 11), 1e-12);
}

// In the lowest row 22 grains turn one way in the first window, and 11 of them turn the other way in the
// second one: a third of the first remains. In the row above all turn by a fifth of it.
TEST(Drift, CentreIsThatOfAllGrainsOfTheWindows) {
    Bed bed;
    Drift drift(bed.scene);
    for (int j = 0; j < 11; ++j) bed.grains.add(1000 + j, 0, {0.5, 2 * j - 10.0, 1}, 0.5, 1);
    const auto turn = [&](double ways) {
        for (std::size_t i = 0; i < bed.grains.size(); ++i) {
            Place& place = bed.grains.place[i];
            const int column = static_cast<int>(std::lround((place.position.y() + 10) / 2));
            const double up = column < 2 ? -1 : column == 3 || column == 4 ? 1 : 0;
            if (place.position.z() < 2) place.position.z() += 4e-3 * ways * up;
            if (place.position.z() > 2 && place.position.z() < 4) place.position.z() += 0.2 * 4e-3 * up;
        }
    };
    drift.note(0, bed.grains, {});
    turn(1), drift.note(4, bed.grains, {});
    Grains left;
    for (std::size_t i = 0; i < bed.grains.size(); ++i)
        if (bed.grains.id[i] < 1000) left.add(bed.grains.id[i], 0, bed.grains.place[i].position, 0.5, 1);
    bed.grains = left;
    turn(-1), drift.note(8, bed.grains, {});
    EXPECT_NEAR(drift.centre(Side::left).y, -7, 1e-12);
    EXPECT_NEAR(drift.centre(Side::left).z, 1, 1e-12);
}

// Four windows without a gap give the mean and standard error of their values. A fifth window replaces the
// first one.
TEST(Drift, HasErrorsOverItsWindows) {
    Bed bed;
    Drift drift(bed.scene);
    drift.note(0, bed.grains, {});
    const double rises[] = {1, 2, 4, 3, 6};
    double height = 0;
    for (int window = 0; window < 5; ++window) {
        height += 4e-3 * rises[window];
        for (std::size_t i = 0; i < bed.grains.size(); ++i)  // only at the left wall
            if (bed.grains.id[i] % 11 == 0)
                bed.grains.place[i].position.z() = 2 * (bed.grains.id[i] / 11) + 1 + height;
        drift.note(4 * (window + 1), bed.grains, {});
    }
    const double mean = 1e-3 * (2 + 4 + 3 + 6) / 4;
    const double squares = 1e-6 * (1.75 * 1.75 + 0.25 * 0.25 + 0.75 * 0.75 + 2.25 * 2.25);
    const Estimate left = drift.rise(Drift::at_left_wall);
    EXPECT_NEAR(left.mean, mean * (1 - 1.0 / 11), 1e-12);
    EXPECT_NEAR(left.error, std::sqrt(squares / 3 / 4) * (1 - 1.0 / 11), 1e-12);
    EXPECT_NEAR(drift.rise(Drift::at_right_wall).mean, -mean / 11, 1e-12);
    EXPECT_NEAR(drift.rise(Drift::in_middle).mean, -mean / 11, 1e-12);
}

// The container stands three diameters to the right, and the grains beside its left wall rise.
TEST(Drift, IsThatAgainstTheContainer) {
    Bed bed;
    Drift drift(bed.scene);
    const DrivePose moved{{0, 3, 0.5}, {0, 0, 0}, 0};
    for (Place& p : bed.grains.place) p.position += moved.offset;
    drift.note(0, bed.grains, moved);
    for (std::size_t i = 0; i < bed.grains.size(); ++i)
        if (bed.grains.id[i] % 11 == 0) bed.grains.place[i].position.z() += 4e-3;
    drift.note(4, bed.grains, moved);
    EXPECT_NEAR(drift.rise(Drift::at_left_wall).mean, 1e-3 * (1 - 1.0 / 11), 1e-12);
    EXPECT_NEAR(drift.rise(Drift::at_right_wall).mean, -1e-3 / 11, 1e-12);
}

// Grains come by a feed. The window before they are there does not count.
TEST(Drift, BeginsWhenThereAreGrains) {
    Bed bed;
    Drift drift(bed.scene);
    drift.note(0, {}, {});
    drift.note(4, {}, {});
    EXPECT_TRUE(std::isnan(drift.rise(Drift::in_middle).mean));
    const auto up_in_middle = [](double y, double) { return std::pair{0.0, std::abs(y) < 3 ? 0.01 : 0.0}; };
    bed.drift(up_in_middle, -1);
    drift.note(8, bed.grains, {});
    bed.drift(up_in_middle, 1);
    drift.note(12, bed.grains, {});
    EXPECT_NEAR(drift.rise(Drift::in_middle).mean, 0.01 * (1 - 3.0 / 11), 1e-12);
}

TEST(Drift, PassesOverGrainsThatComeAndGo) {
    Bed bed;
    Drift drift(bed.scene);
    drift.note(0, bed.grains, {});
    for (std::size_t i = 0; i < bed.grains.size(); ++i)
        if (bed.grains.id[i] == 3) bed.grains.id[i] = 900;
    drift.note(4, bed.grains, {});
    EXPECT_NEAR(drift.rise(Drift::in_middle).mean, 0, 1e-12);
}

}  // namespace
}  // namespace grainreel
