// The line on segregation at the end of a run.
#include "render/run/segregation_text.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "tests/cli/made_frame.hpp"

namespace grainreel {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

Scene of_sizes(const std::vector<double>& diameters) {
    Scene scene;
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
    const std::string text =
        segregation_text(of_sizes({2, 3, 1}), indices(-0.5, 0, 0.1, 0.2), indices(0.25, 0.75, 0.5, 0.9));
    EXPECT_EQ(text,
              "segregation: mean height of b minus c, over the bed's height, from -0.50 to +0.25; "
              "probability that b lies above c from 0.00 to 0.75 (1/2 is mixed); "
              "unlike neighbours over chance from 0.10 to 0.50 (1 is mixed); "
              "Lacey mixing index from 0.20 to 0.90 (1 is mixed)");
    // Of species of one size the first counts as big, as in measures.csv.
    EXPECT_THAT(segregation_text(of_sizes({1, 1}), indices(0, 0, 0, 0), indices(0, 0, 0, 0)),
                testing::HasSubstr("height of a minus b"));
}

TEST(SegregationText, LeavesOutWhatDoesNotHold) {
    const std::string text =
        segregation_text(of_sizes({1, 2}), indices(-0.5, 0, none, none), indices(0.25, 1, 0.5, none));
    EXPECT_THAT(text, testing::EndsWith("probability that b lies above a from 0.00 to 1.00 (1/2 is mixed)"));
}

}  // namespace
}  // namespace grainreel
