// Tests that a silo's walls carry part of the weight.
#include "engine/lab/chart/validation/silo.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grainreel {
namespace {

TEST(Silo, TheFitFindsTheRatioOfItsOwnLaw) {
    std::vector<SiloLoad> loads(4);
    for (std::size_t k = 0; k < loads.size(); ++k) {
        loads[k].filling = 0.5 + static_cast<double>(k);
        loads[k].apparent = janssen(loads[k].filling, 0.13);
    }
    EXPECT_NEAR(fit_janssen(loads).friction_times_ratio, 0.13, 1e-6);
    EXPECT_NEAR(fit_janssen(loads).residual, 0, 1e-5);
}

// Janssen (1895, Z. Ver. Dtsch. Ing. 39, 1045): the floor carries (1 - exp(-4 mu K h)) / (4 mu K) of the
// weight of a column that is one bore high. One K fits both heights. It is the ratio of the pressures times
// the share of the walls' friction that is mobilised, both summed from the contacts.
TEST(Silo, TheFloorCarriesWhatJanssenSays) {
    std::vector<SiloLoad> loads;
    double from_forces = 0;
    SiloColumn column;
    column.bore = 7;
    for (const double aspect : {0.5, 2.0}) {
        column.aspect = aspect;
        loads.push_back(load_of(column));
        from_forces += loads.back().stress_ratio * loads.back().mobilised / 2;
    }
    const JanssenFit fit = fit_janssen(loads);
    const double fitted = fit.friction_times_ratio / column.wall_friction;
    std::printf("[ measured ] K fitted %.3f, from forces %.3f, rms %.4f of the saturation\n", fitted,
                from_forces, fit.residual);
    EXPECT_LT(fit.residual, 0.03);
    EXPECT_NEAR(fitted, from_forces, 0.2 * from_forces);  // single columns scatter by a tenth
    EXPECT_LT(loads.back().apparent, 0.6 * loads.back().filling);
}

// Grains that slide down the wall everywhere use nearly all of its friction: 0.863 in the mean of 60 columns,
// with a deviation of 0.03 for one of them. The bound is three standard errors lower.
TEST(Silo, TheWallsFrictionIsMobilised) {
    constexpr int columns = 4;
    double mobilised = 0;
    for (int seed = 1; seed <= columns; ++seed) {
        SiloColumn column;
        column.bore = 7;
        column.seed = seed;
        mobilised += load_of(column).mobilised / columns;
    }
    std::printf("[ measured ] of the wall's friction %.3f\n", mobilised);
    EXPECT_GT(mobilised, 0.863 - 3 * 0.03 / std::sqrt(columns));
}

}  // namespace
}  // namespace grainreel
