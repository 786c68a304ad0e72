// Steps at which engines dump: the formula of the deck gives just the steps that are wanted.
#include "engine/handover/decks/decks.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace grainreel::test {
namespace {

using testing::ElementsAre;

// What the engine does with the paces.
std::vector<std::int64_t> dumped(const std::vector<DumpPace>& paces) {
    std::vector<std::int64_t> steps;
    for (const DumpPace& pace : paces) {
        if (steps.empty()) steps.push_back(pace.from);
        for (std::int64_t step = pace.next(pace.from); step <= pace.end(); step = pace.next(step))
            steps.push_back(step);
    }
    return steps;
}

TEST(DumpPace, EvenTimesThatAreNoWholeStepsAreOnePace) {
    std::vector<std::int64_t> steps;
    for (int k = 0; k <= 5000; ++k) steps.push_back(17 + std::llround(k * 1234.56789));
    const std::vector<DumpPace> paces = dump_paces(steps);
    EXPECT_EQ(paces.size(), 1U);
    EXPECT_EQ(dumped(paces), steps);
}

TEST(DumpPace, SegmentsOfSeveralRatesAreAsManyPaces) {
    std::vector<std::int64_t> steps{0};
    for (const auto& [every, count] : {std::pair(441.3, 400), {1058.0, 100}, {33.3712, 1000}}) {
        const std::int64_t from = steps.back();
        for (int k = 1; k <= count; ++k) steps.push_back(from + std::llround(k * every));
    }
    const std::vector<DumpPace> paces = dump_paces(steps);
    EXPECT_LE(paces.size(), 5U);
    EXPECT_EQ(dumped(paces), steps);
}

TEST(DumpPace, AnyStepsAreMet) {
    const std::vector<std::int64_t> steps{0, 1, 2, 4, 5, 100, 101, 1000000007, 1000000008};
    EXPECT_EQ(dumped(dump_paces(steps)), steps);
    EXPECT_TRUE(dump_paces({5}).empty());
    EXPECT_TRUE(dump_paces({}).empty());
}

// A run that is interrupted between two dumps asks once more, from any step.
TEST(DumpPace, TheNextDumpIsTheSameFromAnyStepBetween) {
    const DumpPace pace{1000, 7.4, 50};
    for (std::int64_t k = 0; k < 50; ++k)
        for (std::int64_t step = pace.at(k); step < pace.at(k + 1); ++step)
            EXPECT_EQ(pace.next(step), pace.at(k + 1)) << step;
    EXPECT_EQ(pace.next_text(20), "1020+floor(ceil((step-1020+0.5)/7.4)*7.4+0.5)");
}

}  // namespace
}  // namespace grainreel::test
