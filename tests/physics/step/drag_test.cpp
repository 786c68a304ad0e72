// Tests that drag leaves no denormal numbers: a processor needs a hundred times as long for them, and some
// processors count them as zero and others do not.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <initializer_list>

#include "engine/base/system/processor.hpp"
#include "engine/lab/bench/bench_run.hpp"
#include "engine/lab/chart/small_world.hpp"

namespace grainreel {
namespace {

constexpr double kStepLength = 1e-5;  // s

// A cloud of grains without weight, some of which overlap. They push each other apart, rub and spin.
std::unique_ptr<SmallWorld> cloud(Integrator integrator, Precision precision = Precision::full) {
    auto world = std::make_unique<SmallWorld>(latching_pair(bench_stiffness, 0.8, 0.5, precision),
                                              kStepLength, integrator);
    for (int k = 0; k < 64; ++k) {
        const double apart = (k % 3 == 0 ? 1.99 : 2.4) * bench_radius;
        const Vec3 place(apart * (k % 4), 2.3 * bench_radius * (k / 4 % 4), 1.995 * bench_radius * (k / 16));
        world->add(place, Vec3(0.1 * std::cos(k), -0.2, 0.05 * (k % 5)));
        world->grains.motion.back().spin = Vec3(k % 7, 1, -k % 4);
    }
    world->start();
    return world;
}

bool is_denormal(double x) {
    return std::fpclassify(x) == FP_SUBNORMAL;
}

int denormals_in(const SmallWorld& world) {
    int count = 0;
    for (const Motion& motion : world.grains.motion)
        for (int axis = 0; axis < 3; ++axis)
            count += is_denormal(motion.velocity[axis]) + is_denormal(motion.spin[axis]);
    return count;
}

bool is_at_rest(const SmallWorld& world) {
    return world.grains.motion.front().velocity == Vec3::Zero() &&
           world.grains.motion.back().spin == Vec3::Zero();
}

class Drag : public testing::TestWithParam<Integrator> {};

// With 0.5 a step, a speed falls to 1e-308 within 1,420 steps. 0.01 would need 71,000: the springs between
// grains that touch relax more slowly still.
TEST_P(Drag, LeavesNoDenormalNumbers) {
    const auto world = cloud(GetParam());
    for (int k = 0; k < 50; ++k) {
        world->run(100, 0.5 / kStepLength);
        ASSERT_EQ(denormals_in(*world), 0) << world->step;
    }
    EXPECT_TRUE(is_at_rest(*world));
}

TEST_P(Drag, HasTheSameBitsWhetherDenormalNumbersCountAsZero) {
    for (const double a_step : {0.5, 0.02}) {
        const auto world = cloud(GetParam()), flushed = cloud(GetParam());
        world->run(5000, a_step / kStepLength);
        {
            const FlushDenormals flush;
            flushed->run(5000, a_step / kStepLength);
        }
        EXPECT_EQ(hash_of_motion(world->grains), hash_of_motion(flushed->grains)) << a_step;
    }
}

INSTANTIATE_TEST_SUITE_P(Integrators, Drag, testing::Values(Integrator::velocity_verlet, Integrator::gear));

#if defined(__SSE2__)
// The processor ends the process if it meets a denormal number, be it in a history or in the midst of a
// formula.
TEST_P(Drag, GivesTheProcessorNoDenormalNumbers) {
    constexpr unsigned are_ignored = 0x100;
    EXPECT_EXIT(
        {
            const auto world = cloud(GetParam());
            _mm_setcsr(_mm_getcsr() & ~are_ignored);
            world->run(5000, 0.5 / kStepLength);
            std::_Exit(0);
        },
        testing::ExitedWithCode(0), "");
}

// Only laws of floats make the step loop count denormal numbers as zero, and it does so for its own steps
// alone.
TEST(FlushDenormals, ActsWhileItLives) {
    const volatile double least = 5e-324;
    {
        const FlushDenormals off(false);
        EXPECT_NE(least * 1, 0);
        const FlushDenormals flush;
        EXPECT_EQ(least * 1, 0);
    }
    EXPECT_NE(least * 1, 0);
}
#endif

}  // namespace
}  // namespace grainreel
