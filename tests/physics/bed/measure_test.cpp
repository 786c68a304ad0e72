// Tests of segregation indices on states whose index is known.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/numbers.hpp"
#include "engine/base/random.hpp"
#include "engine/measure/segregation/segregation.hpp"
#include "engine/measure/segregation/unlike_neighbours.hpp"

namespace grainreel {
namespace {

struct Lattice {
    std::vector<Vec3> position;
    std::vector<std::uint8_t> marked;
};

// A lattice of 16 x 16 x 32 sites. A site is marked where mark(x, y, z) is true.
template <class Mark>
Lattice lattice(const Mark& mark) {
    Lattice l;
    for (int z = 0; z < 32; ++z) {
        for (int y = 0; y < 16; ++y) {
            for (int x = 0; x < 16; ++x) {
                l.position.emplace_back(x, y, z);
                l.marked.push_back(mark(x, y, z) ? 1 : 0);
            }
        }
    }
    return l;
}

double lacey_of(const Lattice& l) {
    return lacey_index(take_samples(l.position, l.marked));
}
double intensity_of(const Lattice& l) {
    return intensity_of_segregation(take_samples(l.position, l.marked));
}

TEST(Lacey, IsZeroWhenHalvesAreApart) {
    const Lattice l = lattice([](int, int, int z) { return z < 16; });
    EXPECT_NEAR(lacey_of(l), 0, 1e-12);
}

TEST(Lacey, IsOneForARandomMixture) {
    Random random(5, Stream::centres);
    const Lattice l = lattice([&](int, int, int) { return random.uniform() < 0.3; });
    // The variance over 256 samples scatters by sqrt(2 / 255) of sr^2 = s0^2 / 32, so M by 0.003.
    EXPECT_NEAR(lacey_of(l), 1, 4 * 0.003);
}

TEST(Lacey, IsAboveOneForAnOrderedMixture) {
    const Lattice l = lattice([](int x, int y, int z) { return (x + y + z) % 2; });
    EXPECT_NEAR(lacey_of(l), 1 / (1 - 1.0 / kLaceySample), 1e-12);
}

TEST(Lacey, IsUndefinedForOneSpecies) {
    const Lattice l = lattice([](int, int, int) { return true; });
    EXPECT_TRUE(std::isnan(lacey_of(l)));
}

// In a bed of 32 layers the lowest one, or the lowest three, are of the rare kind. A sample of 32 grains
// holds one of them on average, or three.
TEST(Lacey, IsUndefinedWhereSamplesHoldFewOfAKind) {
    const Lattice one = lattice([](int, int, int z) { return z < 1; });
    EXPECT_TRUE(std::isnan(lacey_of(one)));
    const Lattice all_but_one = lattice([](int, int, int z) { return z >= 1; });
    EXPECT_TRUE(std::isnan(lacey_of(all_but_one)));
    const Lattice three = lattice([](int, int, int z) { return z < kLeastOfRareKind; });
    EXPECT_LT(lacey_of(three), 0.5);
}

TEST(Intensity, IsOneWhenHalvesAreApart) {
    EXPECT_NEAR(intensity_of(lattice([](int, int, int z) { return z < 16; })), 1, 1e-12);
}

// In 256 samples of n = 32 the value scatters by sqrt(2 / 255) of the 1 / n of chance.
TEST(Intensity, IsOneOverTheSampleInARandomMixture) {
    Random random(5, Stream::centres);
    const Lattice l = lattice([&](int, int, int) { return random.uniform() < 0.3; });
    EXPECT_NEAR(intensity_of(l), 1.0 / kLaceySample, 4 * std::sqrt(2.0 / 255) / kLaceySample);
}

TEST(Intensity, IsZeroForAnOrderedMixture) {
    EXPECT_NEAR(intensity_of(lattice([](int x, int y, int z) { return (x + y + z) % 2; })), 0, 1e-12);
}

// One layer of 32 is rare, so Lacey's index is undefined. Samples are four layers high: one in eight has a
// share of 1/4.
TEST(Intensity, SeesALayerOfFewGrains) {
    const Lattice l = lattice([](int, int, int z) { return z < 1; });
    const double p = 1.0 / 32, variance = 1.0 / 8 * (1.0 / 4) * (1.0 / 4) - p * p;
    EXPECT_NEAR(intensity_of(l), variance / (p * (1 - p)), 1e-12);
}

TEST(Intensity, IsUndefinedForOneSpecies) {
    EXPECT_TRUE(std::isnan(intensity_of(lattice([](int, int, int) { return true; }))));
}

double above(std::vector<double> these, std::vector<double> those) {
    return share_above(these, those);
}

TEST(ShareAbove, IsTheShareOfPairs) {
    EXPECT_EQ(above({4, 5, 6}, {1, 2, 3}), 1);
    EXPECT_EQ(above({1, 2, 3}, {4, 5, 6}), 0);
    EXPECT_EQ(above({7}, {1, 2, 3}), 1);  // a single intruder on top, half-way and below
    EXPECT_EQ(above({2}, {1, 2, 3}), 0.5);
    EXPECT_EQ(above({0}, {1, 2, 3}), 0);
    EXPECT_EQ(above({1, 1}, {1, 1, 1}), 0.5);
    EXPECT_TRUE(std::isnan(above({}, {1})));
    EXPECT_TRUE(std::isnan(above({1}, {})));
    Random random(1, Stream::centres);
    std::vector<double> these, those;
    for (int i = 0; i < 60; ++i) (i % 3 ? these : those).push_back(std::floor(20 * random.uniform()));
    double pairs = 0;
    for (const double a : these)
        for (const double b : those) pairs += a > b ? 1 : a == b ? 0.5 : 0;
    EXPECT_EQ(above(these, those), pairs / (40 * 20));
}

// If sizes are given out without regard to height, U has the mean n m / 2 and the variance n m (n + m + 1) /
// 12 (Mann and Whitney 1947).
TEST(ShareAbove, IsHalfInARandomMixture) {
    Random random(2, Stream::centres);
    std::vector<double> these, those;
    for (int i = 0; i < 2000; ++i) (random.uniform() < 0.1 ? these : those).push_back(random.uniform());
    const auto n = static_cast<double>(these.size()), m = static_cast<double>(those.size());
    EXPECT_NEAR(share_above(these, those), 0.5, 4 * std::sqrt((n + m + 1) / (12 * n * m)));
}

// Grains of radius 1/2 on the lattice of spacing 1 have six neighbours each inside the bed.
double unlike_of(const Lattice& l) {
    LargeArray<Place> place;
    std::vector<std::int32_t> species;
    for (std::size_t i = 0; i < l.position.size(); ++i) {
        place.push_back({l.position[i], 0.5});
        species.push_back(l.marked[i]);
    }
    return unlike_neighbours(place, species, kNeighbourGap, 0);
}

constexpr double kSites = 16 * 16 * 32, kBonds = 2 * 15 * 16 * 32 + 16 * 16 * 31;

// The share of unlike pairs among all pairs, if neighbours are chosen at random.
double chance(double marked) {
    return marked * (kSites - marked) / (kSites * (kSites - 1) / 2);
}

TEST(UnlikeNeighbours, AreThoseBetweenTheLayersOfALayeredBed) {
    const Lattice halves = lattice([](int, int, int z) { return z < 16; });
    EXPECT_NEAR(unlike_of(halves), 16 * 16 / kBonds / chance(kSites / 2), 1e-12);
    EXPECT_LT(unlike_of(halves), 0.03);
    const Lattice rare = lattice([](int, int, int z) { return z < 1; });
    EXPECT_NEAR(unlike_of(rare), 16 * 16 / kBonds / chance(16 * 16), 1e-12);
    EXPECT_LT(unlike_of(rare), 0.25);
}

TEST(UnlikeNeighbours, AreAllInACheckerboard) {
    const Lattice l = lattice([](int x, int y, int z) { return (x + y + z) % 2; });
    EXPECT_NEAR(unlike_of(l), 1 / chance(kSites / 2), 1e-12);
}

TEST(UnlikeNeighbours, OfASingleGrainAreAllItHas) {
    const Lattice inside = lattice([](int x, int y, int z) { return x == 8 && y == 8 && z == 8; });
    EXPECT_NEAR(unlike_of(inside), 6 / kBonds / chance(1), 1e-12);
    const Lattice corner = lattice([](int x, int y, int z) { return x == 0 && y == 0 && z == 31; });
    EXPECT_NEAR(unlike_of(corner), 3 / kBonds / chance(1), 1e-12);
}

// Labels are drawn by chance, one half each. Every pair is unlike with probability 1/2, and pairs are
// independent (Moran 1948, J. R. Stat. Soc. B 10, 243), so the index scatters by 1 / sqrt(pairs).
TEST(UnlikeNeighbours, AreAsByChanceInARandomMixture) {
    Random random(5, Stream::centres);
    const Lattice l = lattice([&](int, int, int) { return random.uniform() < 0.5; });
    EXPECT_NEAR(unlike_of(l), 1, 4 / std::sqrt(kBonds));
}

TEST(UnlikeNeighbours, AreUndefinedForOneSpeciesAndForGrainsFarApart) {
    EXPECT_TRUE(std::isnan(unlike_of(lattice([](int, int, int) { return true; }))));
    EXPECT_TRUE(std::isnan(unlike_neighbours({{{0, 0, 0}, 0.5}, {{2, 0, 0}, 0.5}}, {0, 1}, 0.9, 0)));
}

// Sizes go from 1 to 20, with three species, with and without a period. The result is the same as by a search
// over all pairs of grains.
TEST(UnlikeNeighbours, AreThoseOfASearchOverAllPairs) {
    for (const double period : {0.0, 0.1}) {
        Random random(9, Stream::centres);
        const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
        LargeArray<Place> place;
        std::vector<std::int32_t> species;
        for (int i = 0; i < 500; ++i) {
            const double radius =
                i % 50 == 0 ? between(0.010, 0.020) : between(0.001, i % 7 ? 0.0012 : 0.003);
            place.push_back({{between(-0.05, 0.05), between(-0.05, 0.05), between(0, 0.1)}, radius});
            species.push_back(i % 50 == 0 ? 2 : i % 7 == 0);
        }
        const double gap = 0.004;
        double all = 0, unlike = 0, weights = 0, unlike_weights = 0;
        for (std::size_t i = 0; i < place.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                Vec3 apart = place[i].position - place[j].position;
                apart.x() = nearest_image(apart.x(), period);
                const double contact = place[i].radius + place[j].radius;
                const bool near = apart.norm() < contact + gap, differ = species[i] != species[j];
                all += near;
                unlike += near && differ;
                weights += contact * contact;
                if (differ) unlike_weights += contact * contact;
            }
        }
        ASSERT_GT(unlike, 100);
        EXPECT_NEAR(unlike_neighbours(place, species, gap, period), unlike / all / (unlike_weights / weights),
                    1e-9);
    }
}

TEST(BedHeight, IsWhereNineteenOfTwentyLieBelow) {
    std::vector<double> heights;
    for (int i = 100; i >= 0; --i) heights.push_back(i);
    EXPECT_EQ(bed_height(heights), 95);
}

}  // namespace
}  // namespace grainreel
