// Segregation indices on states whose index is known.
#include <gtest/gtest.h>

#include "engine/base/random.hpp"
#include "engine/measure/segregation.hpp"

namespace grainreel {
namespace {

struct Lattice {
    std::vector<Vec3> position;
    std::vector<std::uint8_t> marked;
};

// 16 x 16 x 32 sites; a site is marked when `mark(x, y, z)`.
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

TEST(Lacey, IsZeroWhenHalvesAreApart) {
    const Lattice l = lattice([](int, int, int z) { return z < 16; });
    EXPECT_NEAR(lacey_index(l.position, l.marked), 0, 1e-12);
}

TEST(Lacey, IsOneForARandomMixture) {
    Random random(5, Stream::centres);
    const Lattice l = lattice([&](int, int, int) { return random.uniform() < 0.3; });
    // The variance over 256 samples scatters by sqrt(2 / 255) of sr^2 = s0^2 / 32, so M by 0.003.
    EXPECT_NEAR(lacey_index(l.position, l.marked), 1, 4 * 0.003);
}

TEST(Lacey, IsAboveOneForAnOrderedMixture) {
    const Lattice l = lattice([](int x, int y, int z) { return (x + y + z) % 2; });
    EXPECT_NEAR(lacey_index(l.position, l.marked), 1 / (1 - 1.0 / kLaceySample), 1e-12);
}

TEST(Lacey, IsUndefinedForOneSpecies) {
    const Lattice l = lattice([](int, int, int) { return true; });
    EXPECT_TRUE(std::isnan(lacey_index(l.position, l.marked)));
}

TEST(BedHeight, IsWhereNineteenOfTwentyLieBelow) {
    std::vector<double> heights;
    for (int i = 100; i >= 0; --i) heights.push_back(i);
    EXPECT_EQ(bed_height(heights), 95);
}

}  // namespace
}  // namespace grainreel
