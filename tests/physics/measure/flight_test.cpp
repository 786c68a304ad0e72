// Tests of take-off and landing of bodies whose flight is known.
#include "engine/measure/bed/bed_formulas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/physics/measure/inelastic_block.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

constexpr std::int64_t kPeriod = 12800;

// Shows so many periods in stretches of 1/128 period. carried: the share of the weight by the phase at which
// a stretch begins.
Flight shown(int periods, const std::function<double(double turns)>& carried) {
    Flight flight(kPeriod);
    for (std::int64_t step = 0; step < periods * kPeriod; step += 100)
        flight.add(step, carried(static_cast<double>(step) / kPeriod));
    return flight;
}

TEST(Flight, OfAnInelasticBlockBeginsAtAsinOfOneOverGamma) {
    for (const double gamma : {1.2, 2.0, 3.0}) {
        const InelasticBlock block(gamma);
        ASSERT_LT(block.lands, block.leaves + 0.98);
        const auto last = shown(4, [&](double turns) { return block.carried(turns); }).last();
        ASSERT_TRUE(last);
        const auto turns = [](std::int64_t step) { return static_cast<double>(step) / kPeriod; };
        // The plate already carries a tenth of the weight when sin = 0.9 / Gamma.
        const double early = std::asin(0.9 / gamma) / (2 * pi);
        const double from = turns(last->from) - std::floor(turns(last->from));
        EXPECT_GE(from, early - 1e-9) << gamma;
        EXPECT_LE(from, block.leaves + 1.0 / 128) << gamma;
        // It carries more than half of the weight at once, or as soon as the plate's acceleration has fallen
        // to that.
        const double lands = std::max(block.lands, 0.5 - std::asin(0.5 / gamma) / (2 * pi));
        EXPECT_NEAR(turns(last->to - last->from) + from, lands, 1.0 / 128 + 1e-9) << gamma;
    }
}

TEST(Flight, OfABedThatStaysIsNone) {
    EXPECT_FALSE(shown(4, [](double turns) { return 1 - 0.85 * std::sin(2 * pi * turns); }).last());
}

// Short gaps in the force are vibrations of the bed. A few grains that jump about do not end a flight.
TEST(Flight, OfAShortGapDoesNotCount) {
    EXPECT_FALSE(shown(4, [](double turns) {
                     const double t = turns - std::floor(turns);
                     return t > 0.5 && t < 0.55 ? 0.0 : 1.0;
                 }).last());
    const auto last = shown(1, [](double t) {
                          return t < 0.25 || t >= 0.75 ? 1 : t < 0.5 ? 0.0 : 0.3;
                      }).last();
    ASSERT_TRUE(last);
    EXPECT_EQ(last->from, kPeriod / 4);
    EXPECT_EQ(last->to, 3 * kPeriod / 4);
}

}  // namespace
}  // namespace grainreel
