// Tests of columns of segregation of three species, in a container that is not at its place of rest.
#include <gtest/gtest.h>

#include "engine/mesh/room.hpp"
#include "tests/mesh/shapes.hpp"
#include "tests/physics/measure/bed_by_hand.hpp"

namespace grainreel {
namespace {

enum : std::int32_t { small, big, middle };

// The diameters are 1, 3 and 2. The floor is at 1 and the middle of the container is at y = 2.
struct Bed : test::BedByHand {
    Bed() {
        scene.species.resize(3);
        scene.species[middle].name = "middle";
        scene.species[middle].diameter.mean = 2;
        scene.container.half_width = 10;
        scene.drive.present = true;
        pose.offset = {0, 2, 1};
    }
};

// There are 21 grains: 95 % of the ranks 0 to 20 is 19. So the bed is 12 high, a quarter of it is 3 and a
// third is 4.
TEST(SegregationColumns, QuartersAreThoseOfTheBedsHeight) {
    Bed bed;
    for (int i = 1; i <= 14; ++i) bed.add(small, {0, 0, 1 + 0.3 * i}, 0.5);
    bed.add(small, {0, 0, 1 + 12}, 0.5);
    bed.add(middle, {0, 0, 1 + 1}, 1);
    bed.add(middle, {0, 0, 1 + 20}, 1);
    for (const double height : {2.5, 3.5, 8.5, 9.5}) bed.add(big, {0, 0, 1 + height}, 1.5);
    ASSERT_EQ(bed.grains.size(), 21u);
    EXPECT_NEAR(bed.look(0, "bed_top_m"), 12, 1e-12);
    EXPECT_NEAR(bed.look(0, "big_in_top_quarter"), 1.0 / 4, 1e-12);
    EXPECT_NEAR(bed.look(0, "big_in_bottom_quarter"), 1.0 / 4, 1e-12);
    const double mean_small = (0.3 * 14 * 15 / 2 + 12) / 15;
    EXPECT_NEAR(bed.look(0, "height_difference"), (6 - mean_small) / 12, 1e-12);
}

// The same bed lies in a vessel whose file has its floor at z = -20. Heights count from there, and their
// difference keeps its sign.
TEST(SegregationColumns, CountHeightsFromTheBaseOfAMeshVessel) {
    Bed bed;
    bed.scene.container.shape = Container::Shape::mesh;
    bed.scene.container.room.of =
        std::make_shared<EnclosedRoom>(shapes::mended(shapes::box({-2, -10, -20}, {2, 10, 10})));
    for (int i = 0; i <= 20; ++i) bed.add(i % 2 == 0 ? small : big, {0, 0, 1 - 20 + 0.5 * (i + 1)}, 0.5);
    EXPECT_NEAR(bed.look(0, "bed_top_m"), 10, 1e-12);  // 95 % of the ranks 0 to 20 is 19
    EXPECT_NEAR(bed.look(0, "small_height_m"), 5.5, 1e-12);
    EXPECT_NEAR(bed.look(0, "big_height_m"), 5.5, 1e-12);
    EXPECT_NEAR(bed.look(0, "height_difference"), 0, 1e-12);
    bed.add(big, {0, 0, 1 - 20 + 27.5}, 0.5);  // the mean of eleven grains is 2 higher
    EXPECT_NEAR(bed.look(0, "big_height_m"), 7.5, 1e-12);
    EXPECT_GT(bed.look(0, "height_difference"), 0);
}

// Walls are at y = -8 and 12. A big grain is beside a wall that is nearer to its centre than 1.5 + 1.
TEST(SegregationColumns, BothWallsCountWhereTheyAreNow) {
    Bed bed;
    for (const double y : {-6.0, -6.2, 10.0, 0.0}) bed.add(big, {0, y, 5}, 1.5);
    for (const double y : {-7.5, 11.5, 3.0}) bed.add(small, {0, y, 5}, 0.5);
    EXPECT_NEAR(bed.look(0, "big_at_walls"), 3.0 / 4, 1e-12);
}

// A small grain touches a big one through the periodic ends and has a small one at a gap of 0.1. The other
// small grain is 0.37 away from the big one, further than a quarter of the smallest diameter. By chance,
// pairs weigh (r + r)^2.
TEST(SegregationColumns, NeighboursAreWithinAQuarterOfTheSmallestDiameter) {
    Bed bed;
    bed.period = 6;
    bed.add(small, {-2.9, 0, 5}, 0.5);
    bed.add(small, {-2.9, 1.1, 5}, 0.5);
    bed.add(big, {1, 0, 5}, 1.5);
    EXPECT_NEAR(bed.look(0, "unlike_neighbours"), (1.0 / 2) / (8.0 / 9), 1e-12);
}

// There are two samples of two grains. The big one has the shares 1/2 and 0 in them and 1/4 of all, so s^2 =
// 1/16.
TEST(SegregationColumns, MixingIsThatOfTheLargestSpecies) {
    Bed bed;
    bed.add(middle, {0, 0, 2}, 1);
    bed.add(big, {0, 0, 4}, 1.5);
    bed.add(small, {0, 0, 6}, 0.5);
    bed.add(small, {0, 0, 7}, 0.5);
    EXPECT_NEAR(bed.look(0, "intensity"), (1.0 / 16) / (3.0 / 16), 1e-12);
}

TEST(SegregationColumns, OfSpeciesOfOneSizeTheFirstIsSetAgainstTheSecond) {
    Bed bed;
    for (Species& species : bed.scene.species) species.diameter.mean = 1;
    bed.add(0, {0, 0, 1 + 3}, 0.5);
    bed.add(1, {0, 0, 1 + 2}, 0.5);
    EXPECT_NEAR(bed.look(0, "height_difference"), (3.0 - 2) / 2, 1e-12);  // 95 % of the ranks 0 and 1 is 0
}

}  // namespace
}  // namespace grainreel
