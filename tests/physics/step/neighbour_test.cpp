// Tests of neighbour lists against a search over all pairs, for sizes that need several grids.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <set>
#include <utility>

#include "engine/step/grid/neighbours.hpp"
#include "engine/step/lists/contact_table.hpp"
#include "tests/instruction_sets.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

Team alone(1);

using Pairs = std::multiset<std::pair<std::int32_t, std::int32_t>>;

// Radii go from 1 to 20 mm in a column three times as high as wide; a fifth of the grains are far above it.
Grains of_all_sizes(unsigned seed) {
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    Grains grains;
    for (int i = 0; i < 600; ++i) {
        const double radius = i % 50 == 0 ? between(0.010, 0.020) : between(0.001, i % 7 ? 0.0012 : 0.003);
        const double height = i % 5 == 1 ? between(0.3, 30) : between(0, 0.3);
        grains.add(i, 0, Vec3(between(-0.05, 0.05), between(-0.05, 0.05), height), radius, 2500);
    }
    return grains;
}

Pairs listed(const NeighbourList& list) {
    Pairs pairs;
    for (std::int32_t i = 0; i + 1 < static_cast<std::int32_t>(list.start.size()); ++i) {
        for (std::int32_t at = list.start[i]; at < list.start[i + 1]; ++at)
            pairs.insert({i, list.partner[at]});
    }
    return pairs;
}

// Whether the neighbours in the list rise. Code that tells candidates from contacts relies on it.
bool rise(const NeighbourList& list, std::int32_t i) {
    return std::is_sorted(list.partner.begin() + list.start[i], list.partner.begin() + list.start[i + 1]);
}

Pairs all_near(const Grains& grains, double skin, double period) {
    Pairs pairs;
    const auto n = static_cast<std::int32_t>(grains.size());
    for (std::int32_t i = 0; i < n; ++i) {
        for (std::int32_t j = i + 1; j < n; ++j) {
            Vec3 apart = grains.place[j].position - grains.place[i].position;
            apart.x() = nearest_image(apart.x(), period);
            if (apart.norm() < grains.place[i].radius + grains.place[j].radius + skin) pairs.insert({i, j});
        }
    }
    return pairs;
}

class Neighbours : public testing::TestWithParam<double> {};

TEST_P(Neighbours, AreAllPairsThatAreNear) {
    const double period = GetParam(), skin = 0.004;
    for (unsigned seed = 1; seed <= 5; ++seed) {
        Grains grains = of_all_sizes(seed);
        Cells cells;
        std::vector<std::int32_t> new_index;
        put_in_order({alone, 0}, cells, grains, skin, period, new_index);
        EXPECT_GE(cells.levels().size(), 3u);
        NeighbourList low, high, whole;
        const std::int32_t n = static_cast<std::int32_t>(grains.size()), middle = n / 3;
        list_pairs(cells, grains, skin, period, 0, middle, low);
        list_pairs(cells, grains, skin, period, middle, n, high);
        whole.resize(n, low.size() + high.size());
        whole.put(low, 0, 0);
        whole.put(high, middle, low.size());
        const Pairs expected = all_near(grains, skin, period);
        EXPECT_GT(expected.size(), 80u);
        EXPECT_EQ(listed(whole), expected);
        for (std::int32_t i = 0; i < n; ++i) EXPECT_TRUE(rise(whole, i)) << i;
        std::int32_t farthest = 0;
        for (const auto& [i, j] : expected) farthest = std::max(farthest, j - i);
        EXPECT_EQ(std::max(low.farthest_partner, high.farthest_partner), farthest);
    }
}

// The periods are: none; that of the bed; and one that the largest grain's neighbourhood nearly fills.
INSTANTIATE_TEST_SUITE_P(Periods, Neighbours, testing::Values(0.0, 0.1, 0.06));

// Gives every value of a grain a number that tells whose it is.
void mark(Grains& grains) {
    const std::size_t n = grains.size();
    grains.rounded.resize(n), grains.orientation.resize(n), grains.derivatives.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double d = grains.id[i];
        const Vec3 v(d, d + 0.25, d + 0.5);
        grains.species[i] = 2 * grains.id[i];
        grains.wall_work[i] = d;
        grains.motion[i].velocity = v, grains.motion[i].spin = 2 * v;
        grains.rounded[i].velocity[0] = grains.rounded[i].radius = static_cast<float>(d);
        grains.orientation[i].coeffs() << v, d;
        grains.derivatives[i] = {v, 2 * v, 3 * v, 4 * v};
    }
}

TEST(Order, TakesAllThatAGrainHasWithIt) {
    for (const int members : {1, 3}) {
        Team team(members);
        Grains grains = of_all_sizes(3);
        mark(grains);
        const Grains before = grains;
        Cells cells;
        std::vector<std::int32_t> new_index;
        team.run([&](int member) { put_in_order({team, member}, cells, grains, 0.004, 0, new_index); });
        EXPECT_NE(grains.id, before.id);
        for (std::size_t old = 0; old < before.size(); ++old) {
            const std::size_t i = new_index[old];
            ASSERT_EQ(grains.id[i], before.id[old]);
            EXPECT_EQ(grains.species[i], before.species[old]);
            EXPECT_EQ(grains.wall_work[i], before.wall_work[old]);
            EXPECT_EQ(grains.place[i].position, before.place[old].position);
            EXPECT_EQ(grains.place[i].radius, before.place[old].radius);
            EXPECT_EQ(std::memcmp(&grains.motion[i], &before.motion[old], sizeof(Motion)), 0);
            EXPECT_EQ(std::memcmp(&grains.rounded[i], &before.rounded[old], sizeof(RoundedMotion)), 0);
            EXPECT_EQ(grains.orientation[i].coeffs(), before.orientation[old].coeffs());
            EXPECT_EQ(std::memcmp(&grains.derivatives[i], &before.derivatives[old], sizeof(Derivatives)), 0);
            EXPECT_EQ(grains.load[i].force, Vec3(0, 0, 0));
            EXPECT_EQ(grains.load[i].torque, Vec3(0, 0, 0));
        }
    }
}

// Otherwise every grain would look at twice as many others.
TEST(Cells, LeadingLevelStandsInItsGridsOrder) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        for (const double period : {0.0, 0.1}) {
            Grains grains = of_all_sizes(seed);
            Cells cells;
            std::vector<std::int32_t> new_index;
            put_in_order({alone, 0}, cells, grains, 0.004, period, new_index);
            int leading = 0;
            for (const Cells::Level& level : cells.levels()) {
                if (!level.leads) continue;
                ++leading;
                EXPECT_TRUE(level.rising) << seed << ' ' << period;
            }
            EXPECT_EQ(leading, 1);
        }
    }
}

// The neighbours are the same on each instruction set.
TEST(NeighboursAtWidths, AreTheSame) {
    Grains grains = of_all_sizes(7);
    Cells cells;
    std::vector<std::int32_t> new_index;
    put_in_order({alone, 0}, cells, grains, 0.004, 0, new_index);
    const Pairs expected = all_near(grains, 0.004, 0);
    test::for_each_instruction_set([&](std::int64_t) {
        NeighbourList list;
        list_pairs(cells, grains, 0.004, 0, 0, static_cast<std::int32_t>(grains.size()), list);
        EXPECT_EQ(listed(list), expected);
    });
}

// Candidates are the offered pairs that are no contacts, whichever pairs these are.
TEST(ContactTable, TellsCandidatesFromContacts) {
    std::mt19937 random(3);
    for (int round = 0; round < 20; ++round) {
        ContactTable table;
        table.shape(1, sizeof(double));
        Pairs candidates;
        std::vector<std::pair<std::int32_t, std::int32_t>> near;
        KeptContacts contacts;
        for (std::int32_t i = 0; i < 60; ++i) {
            for (std::int32_t j = i + 1; j < 80; j += 1 + static_cast<std::int32_t>(random() % 20)) {
                const bool touches = random() % 3 == 0, is_near = random() % 10 != 0;
                if (is_near) near.emplace_back(i, j);
                if (is_near && !touches) candidates.insert({i, j});
                if (!touches) continue;
                contacts.first.push_back(i), contacts.second.push_back(j);
                contacts.tag.push_back(0), contacts.history.push_back(0);
            }
        }
        for (std::size_t k = 0; k < contacts.size(); ++k) table.take(contacts, k);
        table.forget_order();
        table.sort();
        EXPECT_EQ(table.sorted(), static_cast<std::int32_t>(contacts.size()));
        for (int again = 0; again < 2; ++again) {
            table.begin_candidates();
            for (const auto& [i, j] : near) table.offer(i, j);
            table.end_candidates();
            Pairs found;
            for (std::int32_t c = 0; c < table.candidates(); ++c)
                found.insert({table.near_first()[c], table.near_second()[c]});
            EXPECT_EQ(found, candidates) << round;
        }
    }
}

// Pairs part slowly after a fast impact. Lists made for the speed before the impact would last hundreds of
// steps, and contacts that have ended would be computed in each of them.
TEST(Lists, DropContactsThatHaveParted) {
    constexpr int pairs = 60, patience = 40;  // steps: of half a contact a grain, 16 are worth a refresh
    for (const int threads : {1, 3}) {
        HandMadeBed w = make_world(walton_braun_pair(0.1, 0.3), 2e-6);
        w.team = std::make_unique<Team>(threads);
        for (int k = 0; k < pairs; ++k) {
            const Vec3 one(0, 0, 0.01 * k), two(2.001 * kRadius, 0, 0.01 * k);
            for (const auto& [at, speed] : {std::pair{one, 0.3}, std::pair{two, -0.3}}) {
                w.grains.add(static_cast<std::int32_t>(w.grains.size()), 0, at, kRadius, kDensity);
                w.grains.motion.back().velocity = Vec3(speed, 0, 0);
            }
        }
        w.start();
        const auto touching = [&] {
            int count = 0;
            w.loop->visit_contacts(w.step, [&](const ContactView&) { ++count; });
            return count;
        };
        while (touching() == 0) w.run(1);
        while (touching() > 0) w.run(1);
        const std::int64_t before = w.loop->refreshes();
        w.run(patience);
        EXPECT_EQ(w.loop->refreshes(), before + 1) << threads;
    }
}

}  // namespace
}  // namespace grainreel
