#include "engine/measure/fields/kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grainreel {
namespace {

constexpr double kWidth = 0.7;

// By the midpoint rule, function of t from `from` to `to`.
template <class Function>
double sum_over(double from, double to, const Function& function) {
    constexpr int count = 20000;
    const double step = (to - from) / count;
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += function(from + (i + 0.5) * step);
    return sum * step;
}

class Kernels : public ::testing::TestWithParam<FieldOutput::Kernel> {};

TEST_P(Kernels, LineIntegralIsThatOfTheValues) {
    for (const int dimensions : {2, 3}) {
        const FieldKernel kernel(GetParam(), kWidth, dimensions);
        const double reach = kernel.cutoff();
        for (const double away : {0.0, 0.01 * reach, 0.5 * reach, 0.99 * reach, 1.01 * reach})
            for (const auto& [from, to] : {std::pair{-2 * reach, 2 * reach},
                                           {0.1 * reach, 0.3 * reach},
                                           {-0.4 * reach, 0.9 * reach},
                                           {1.1 * reach, 1.3 * reach}})
                EXPECT_NEAR(kernel.along(away * away, from, to),
                            sum_over(from, to, [&](double t) { return kernel.at(away * away + t * t); }),
                            1e-4 * reach)
                    << away << " " << from << " " << to;
    }
}

TEST_P(Kernels, EndAtTheirCutoffAndAreOneInTheMiddle) {
    const FieldKernel kernel(GetParam(), kWidth, 3);
    EXPECT_EQ(kernel.at(0), 1);
    EXPECT_GT(kernel.at(std::pow(0.99 * kernel.cutoff(), 2)), 0);
    EXPECT_EQ(kernel.at(std::pow(1.01 * kernel.cutoff(), 2)), 0);
}

INSTANTIATE_TEST_SUITE_P(Both, Kernels,
                         ::testing::Values(FieldOutput::Kernel::gaussian, FieldOutput::Kernel::lucy));

TEST(LucyKernel, HasItsWidthAsStandardDeviationAlongEachAxis) {
    for (const int dimensions : {2, 3}) {
        const FieldKernel kernel(FieldOutput::Kernel::lucy, kWidth, dimensions);
        const auto moment = [&](int power) {
            return sum_over(0, kernel.cutoff(),
                            [&](double r) { return std::pow(r, dimensions - 1 + power) * kernel.at(r * r); });
        };
        EXPECT_NEAR(std::sqrt(moment(2) / moment(0) / dimensions), kWidth, 1e-6);
    }
}

}  // namespace
}  // namespace grainreel
