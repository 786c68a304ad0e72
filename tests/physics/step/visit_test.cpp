// Tests of the order in which contacts are shown.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

// Two pairs meet, the second one ten steps before the first. With two threads each thread has one pair.
HandMadeBed two_pairs(int threads) {
    constexpr double kStep = 1e-6, kSpeed = 0.5, kApart = 0.05;  // s, m/s, m
    HandMadeBed w =
        make_world(walton_braun_pair(0.9, 0), kStep, NormalForce::walton_braun, TangentialLaw::none);
    for (const int pair : {0, 1}) {
        const double gap = 2 * kSpeed * kStep * (pair == 0 ? 20 : 10);
        for (const int grain : {0, 1}) {
            const Vec3 at(grain * (2 * kRadius + gap), 0, pair * kApart);
            w.grains.add(2 * pair + grain, 0, at, kRadius, kDensity);
            w.grains.motion.back().velocity.x() = grain == 0 ? kSpeed : -kSpeed;
        }
    }
    w.team = std::make_unique<Team>(threads);
    return w;
}

TEST(VisitContacts, TakesNewOnesInOneOrderOnAnyNumberOfThreads) {
    for (const int threads : {1, 2, 3}) {
        HandMadeBed w = two_pairs(threads);
        w.start();
        w.run(30);
        ASSERT_EQ(w.loop->refreshes(), 1) << "both contacts are to be new ones";
        std::vector<std::pair<std::int32_t, std::int32_t>> seen;
        w.loop->visit_contacts(w.step, [&](const ContactView& c) { seen.emplace_back(c.first, c.second); });
        const std::vector<std::pair<std::int32_t, std::int32_t>> rising{{0, 1}, {2, 3}};
        EXPECT_EQ(seen, rising) << threads;
    }
}

}  // namespace
}  // namespace grainreel
