// Tests of the line on segregation at the end of a run.
#include "engine/run/folder/scene_job.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "engine/run/driver/run_files.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/cli/made_frame.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

FilmedScene of_sizes(const std::vector<double>& diameters) {
    FilmedScene scene;
    for (const double diameter : diameters) {
        Species species;
        species.name = std::string(1, static_cast<char>('a' + scene.species.size()));
        species.diameter.mean = species.diameter.smallest = species.diameter.largest = diameter;
        scene.species.push_back(species);
    }
    return scene;
}

Measures indices(double height, double above, double unlike, double lacey) {
    const std::vector<std::string> names{"height_difference", "big_above_small", "unlike_neighbours",
                                         "lacey"};
    return {std::make_shared<const std::vector<std::string>>(names), {height, above, unlike, lacey}};
}

TEST(SegregationText, SpeaksOfTheLargestAndTheSmallestSpecies) {
    const std::string text = segregation_text(of_sizes({2, 3, 1}), indices(-0.5, 0, 0.1, 0.2),
                                              indices(0.25, 0.75, 0.7, 0.9), "the last 10 periods");
    EXPECT_EQ(text,
              "segregation, from the start to the mean over the last 10 periods: mean height of b minus c, "
              "divided by the bed's height, from -0.50 to +0.25; "
              "probability that b lies above c from 0.00 to 0.75 (1/2 is mixed); "
              "unlike neighbours, divided by what chance gives, from 0.10 to 0.70 (1 is mixed); "
              "Lacey mixing index from 0.20 to 0.90 (1 is mixed)");
    // If species have the same size, the first counts as big, as in measures.csv.
    EXPECT_THAT(segregation_text(of_sizes({1, 1}), indices(0, 0, 0, 0), indices(0, 0, 0, 0), "the last row"),
                testing::HasSubstr("height of a minus b"));
}

TEST(SegregationText, LeavesOutWhatDoesNotHold) {
    const std::string text = segregation_text(of_sizes({1, 2}), indices(-0.5, 0, none, none),
                                              indices(0.25, 1, 0.5, none), "the last row");
    EXPECT_THAT(text, testing::EndsWith("probability that b lies above a from 0.00 to 1.00 (1/2 is mixed)"));
}

TEST(SegregationText, SpeaksForNoneOfThoseThatDisagree) {
    const FilmedScene scene = of_sizes({1, 2});
    const auto text = [&](double unlike, double lacey) {
        return segregation_text(scene, indices(0, 0.5, 1, 1), indices(0.2, 0.6, unlike, lacey),
                                "the last 3 s");
    };
    EXPECT_THAT(text(0.7, 0.24), tells({"neighbours and samples", "32 grains", "disagree"}));
    EXPECT_THAT(text(0.7, 0.6), testing::Not(testing::HasSubstr("disagree")));
    EXPECT_THAT(text(0.7, none), testing::Not(testing::HasSubstr("disagree")));
}

Measures row(double step, double value) {
    static const auto names = std::make_shared<const std::vector<std::string>>(
        std::vector<std::string>{"step", "height_difference"});
    return {names, {step, value}};
}

// There are eight rows a period that vary by 1 about a value, which rises by 0.1 a period.
TEST(LateMeansOfARun, AreOverWholePeriods) {
    const Clock clock{1e-3, 80, 0};
    LateMeans late(clock, 3);
    const auto value = [](int k) { return 0.1 * (k / 8) + (k % 8 == 0 ? 7 : -1); };
    for (int k = 0; k <= 8 * 25; ++k) {
        late.add(row(10 * k, value(k)));
        if (k == 3) {
            EXPECT_EQ(late.over(), "the last row");
            EXPECT_EQ(late.means().at("height_difference"), value(3));
        }
        if (k == 9) {
            EXPECT_EQ(late.over(), "the last period");
        }
        if (k == 20) {
            EXPECT_EQ(late.over(), "the last 2 periods");
        }
    }
    EXPECT_EQ(late.over(), "the last 10 periods");
    double sum = 0;
    for (int k = 8 * 15 + 1; k <= 8 * 25; ++k) sum += value(k);
    EXPECT_NEAR(late.means().at("height_difference"), sum / 80, 1e-12);
}

TEST(LateMeansOfARun, AreOverTheLastTenthWithoutADrive) {
    LateMeans late(Clock{1e-3, 0, 0}, 2);
    for (int k = 0; k <= 2000; k += 10) late.add(row(k, k == 1900 ? none : k));
    EXPECT_EQ(late.over(), "the last 0.2 s");
    double sum = 0;
    for (int k = 1810; k <= 2000; k += 10) sum += k == 1900 ? 0 : k;
    EXPECT_NEAR(late.means().at("height_difference"), sum / 19, 1e-12);
}

}  // namespace
}  // namespace grainreel
