// Tests of a granular gas that cools, and of one that should not.
#include "engine/lab/chart/validation/cooling_gas.hpp"

#include <gtest/gtest.h>

#include "engine/lab/chart/gas.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

// Haff 1983, J. Fluid Mech. 134, 401, with Enskog's collision rate and nothing fitted. Seeds scatter by 3 %,
// and contacts that last make the gas hotter by 2 to 4 % (the chart `validation` shows this against the
// stiffness).
TEST(Gas, CoolsAsHaffSays) {
    const std::vector<double> times = {0.5, 1, 2};
    std::vector<double> mean(times.size());
    CoolingGas gas;
    gas.stiffness = 4e4;
    gas.precision = tested_precision();
    constexpr int seeds = 3;
    for (gas.seed = 1; gas.seed <= seeds; ++gas.seed) {
        const std::vector<double> is = cool(gas, times);
        for (std::size_t k = 0; k < times.size(); ++k) mean[k] += is[k] / seeds;
    }
    for (std::size_t k = 0; k < times.size(); ++k) {
        EXPECT_NEAR(mean[k], haff(times[k]), 0.08 * haff(times[k])) << "after " << times[k] << " tau";
        std::printf("[ measured ] T / Haff's = %.3f after %.1f tau\n", mean[k] / haff(times[k]), times[k]);
    }
}

// The energy divided by the energy at the start, after 1,000 contact times, in which each grain has some ten
// impacts.
GasEnergy changed(const std::string& law, double restitution, std::vector<std::string> sets = {}) {
    const GasSetting setting{"", law, with_tested_precision(std::move(sets))};
    return gas_energy(gas_plan(setting, restitution), 1, {1000}, [] { return true; }).front();
}

// At e = 1 Walton and Braun's spring is a linear one, with or without corrections of its contacts, and its
// grains go the same ways.
TEST(Gas, ElasticDriftsAsSpringDashpotWithoutDamping) {
    const double dashpot = changed("spring-dashpot", 1).gained;
    for (const char* corrections : {"true", "false"}) {
        const double latching =
            changed("walton-braun", 1, {std::string("run.contact_corrections=") + corrections}).gained;
        EXPECT_LE(std::abs(latching), 2 * std::abs(dashpot)) << "corrections " << corrections;
        // If the grains went other ways, the results would differ by 1e-4. (Floats store the springs' energy
        // by another formula.)
        EXPECT_NEAR(latching, dashpot, of_rounding(0, 1e-9)) << "corrections " << corrections;
    }
    std::printf("[ measured ] an elastic gas gains %+.1e\n", dashpot);
    EXPECT_LT(std::abs(dashpot), 5e-4);
}

// The energy that it gains by errors of the step is far below what its impacts should take.
TEST(Gas, NearlyElasticLosesWhatItsImpactsTake) {
    for (const double e : {0.99, 0.997, 0.999, 0.9999}) {
        const GasEnergy change = changed("walton-braun", e);
        EXPECT_LT(std::abs(change.gained), 0.1 * change.lost) << "e = " << e;
        std::printf("[ measured ] e = %g: gains %+.3f of what it should lose\n", e,
                    change.gained / change.lost);
    }
}

}  // namespace
}  // namespace grainreel
