// Which candidates are looked at in a step.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "engine/step/lists/soon.hpp"

namespace grainreel {
namespace {

// Its first list, the others being asked for nothing.
template <class Work>
void with_first_list(Soon& soon, const Work& work) {
    bool first = true;
    soon.each(1, [&](SoonList& list, double) {
        if (first) work(list);
        first = false;
    });
}

TEST(Soon, HoldsPairsInOrderAndFillsTheLastBlock) {
    Soon soon;
    soon.expire(64 * Soon::kLists);
    with_first_list(soon, [&](SoonList& list) {
        list.begin(0, 1);
        for (std::int32_t k = 0; k < 21; ++k) list.add(k, 100 + k, 2 * k);
        list.end();
        ASSERT_EQ(list.size(), 21);
        for (std::int32_t k = 0; k < 21; ++k) {
            EXPECT_EQ(list.first()[k], k);
            EXPECT_EQ(list.second()[k], 100 + k);
            EXPECT_EQ(list.at(k), 2 * k);
        }
        for (std::int32_t k = 21; k < (21 + kBlock - 1) / kBlock * kBlock; ++k) {
            EXPECT_EQ(list.first()[k], 20);
            EXPECT_EQ(list.second()[k], 120);
        }
        EXPECT_TRUE(list.has_room(9));
        EXPECT_FALSE(list.has_room(60));
        EXPECT_FALSE(list.are_all());
        list.give_up();
        EXPECT_TRUE(list.are_all());
        list.begin(0, 1);
        list.end();
        EXPECT_FALSE(list.are_all());
        EXPECT_EQ(list.size(), 0);
    });
}

// As many pairs as fit do not reach into the next list's room, and all lists together have all candidates.
TEST(Soon, ListsHaveRoomOfTheirOwn) {
    for (const std::int32_t candidates : {0, 1, 15, 64, 100, 321, 640, 5000, 5063}) {
        Soon soon;
        soon.expire(candidates);
        std::int32_t next = 0, noted = 0;
        const auto fill = [&](SoonList& list, double) {
            EXPECT_EQ(list.from(), next);
            EXPECT_EQ(list.from() % kChunk, 0);
            next = list.to();
            list.begin(0, 1);
            while (list.has_room(1)) list.add(list.from(), list.to(), noted++);
            list.end();
        };
        soon.each(1, fill);
        EXPECT_EQ(next, candidates);
        EXPECT_GE(noted, candidates / 2);
        std::int32_t seen = 0;
        soon.each(1, [&](SoonList& list, double) {
            for (std::int32_t k = 0; k < list.size(); ++k) {
                EXPECT_EQ(list.first()[k], list.from());
                EXPECT_EQ(list.second()[k], list.to());
                EXPECT_EQ(list.at(k), seen++);
            }
        });
        EXPECT_EQ(seen, noted);
    }
}

// In a motion that uses up the gap in some steps, no step makes all lists but the first.
TEST(Soon, ListsTakeTurns) {
    Soon soon;
    soon.expire(10'000);
    const double gap = 1, moved_in_a_step = 0.101;
    for (int step = 0; step < 40; ++step) {
        int made = 0;
        soon.each(gap, [&](SoonList& list, double its_gap) {
            if (list.lasts(step * moved_in_a_step)) return;
            ++made;
            EXPECT_LE(its_gap, gap);
            list.begin(step * moved_in_a_step, its_gap);
            list.end();
        });
        EXPECT_EQ(made, step == 0 ? Soon::kLists : 1) << step;
    }
}

// Two grains that each move by half the gap may touch; until then, none that is left out can.
TEST(Soon, LastsUntilAPairThatIsLeftOutCouldTouch) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(0, 1);
    for (int round = 0; round < 1000; ++round) {
        const double before = any(random), gap = 0.01 * any(random);
        Soon soon;
        soon.expire(1);
        with_first_list(soon, [&](SoonList& list) {
            EXPECT_FALSE(list.lasts(0));
            list.begin(before, gap);
            EXPECT_TRUE(list.lasts(before));
            EXPECT_TRUE(list.lasts(before + 0.4 * gap));
            for (const double share : {0.5, 0.51, 1.0, 30.0}) EXPECT_FALSE(list.lasts(before + share * gap));
        });
        soon.expire(1);
        with_first_list(soon, [&](SoonList& list) { EXPECT_FALSE(list.lasts(before)); });
    }
}

}  // namespace
}  // namespace grainreel
