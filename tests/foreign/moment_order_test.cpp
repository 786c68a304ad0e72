// The order of the moments of a run's files, and what is left out after a restart.
#include "engine/files/foreign/moment_order.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace grainreel {
namespace {

using testing::ElementsAre;

// Frames of one grain with these steps, one after the other in a file.
std::vector<PlacedMoment> file_of(const std::vector<std::int64_t>& steps, std::size_t file = 0) {
    std::vector<PlacedMoment> all;
    for (const std::int64_t step : steps) {
        PlacedMoment& one = all.emplace_back();
        one.moment.step = step;
        one.moment.grains = 1;
        one.file = file;
        one.frame = all.size() - 1;
    }
    return all;
}

std::vector<PlacedMoment> operator+(std::vector<PlacedMoment> a, const std::vector<PlacedMoment>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

const OrderedMoments::AreParts one_run = [](const PlacedMoment&, const PlacedMoment&) { return false; };
const OrderedMoments::AreParts processes = [](const PlacedMoment&, const PlacedMoment&) { return true; };

// The numbers of the frames that are taken, by rising step.
std::vector<std::size_t> taken(const std::vector<PlacedMoment>& all) {
    std::vector<std::size_t> frames;
    for (const auto& parts : in_order(all, one_run).moments) {
        EXPECT_EQ(parts.size(), 1u);
        frames.push_back(parts.front().frame);
    }
    return frames;
}

TEST(MomentOrder, ARestartReplacesWhatTheRunHadGivenUp) {
    // Frames of the branch that was given up, at steps that do not come again: 350 and 450.
    const auto branch = file_of({0, 100, 200, 300, 350, 450, 300, 400, 500});
    EXPECT_THAT(taken(branch), ElementsAre(0, 1, 2, 6, 7, 8));
    const OrderedMoments::GoneBack gone_back = in_order(branch, one_run).gone_back;
    EXPECT_EQ(gone_back.twice, 1u);
    EXPECT_EQ(gone_back.given_up, 2u);
    EXPECT_EQ(gone_back.from, 450);
    EXPECT_EQ(gone_back.to, 300);
    // The new branch ends before the old one had.
    EXPECT_THAT(taken(file_of({0, 100, 200, 300, 400, 500, 300, 400})), ElementsAre(0, 1, 2, 6, 7));
    // It has no step of the old one.
    EXPECT_THAT(taken(file_of({0, 100, 200, 300, 400, 250, 350})), ElementsAre(0, 1, 2, 5, 6));
    // It has one frame so far.
    EXPECT_THAT(taken(file_of({0, 100, 200, 300, 400, 250})), ElementsAre(0, 1, 2, 5));
    // From the start.
    EXPECT_THAT(taken(file_of({0, 100, 200, 0, 100})), ElementsAre(3, 4));
    // Two restarts, the second from before the first.
    EXPECT_THAT(taken(file_of({0, 100, 200, 300, 200, 300, 100, 200})), ElementsAre(0, 6, 7));
}

TEST(MomentOrder, PiecesInAnyOrderAreAllKept) {
    EXPECT_THAT(taken(file_of({400, 500, 600, 0, 100, 200, 300})), ElementsAre(3, 4, 5, 6, 0, 1, 2));
    EXPECT_THAT(taken(file_of({0, 100, 200, 500, 600, 300, 400})), ElementsAre(0, 1, 2, 5, 6, 3, 4));
    // They overlap by a frame.
    EXPECT_THAT(taken(file_of({300, 400, 500, 0, 100, 200, 300})), ElementsAre(3, 4, 5, 6, 1, 2));
    EXPECT_THAT(taken(file_of({0, 100, 200, 200, 300})), ElementsAre(0, 1, 3, 4));
    EXPECT_THAT(taken(file_of({0, 0, 100})), ElementsAre(1, 2));
}

TEST(MomentOrder, FilesOfOneRunFollowEachOther) {
    const auto two = file_of({0, 100, 200, 300, 400}, 0) + file_of({200, 300}, 1);
    const OrderedMoments ordered = in_order(two, one_run);
    ASSERT_EQ(ordered.moments.size(), 4u);
    EXPECT_EQ(ordered.moments[1][0].file, 0u);
    EXPECT_EQ(ordered.moments[2][0].file, 1u);
    EXPECT_EQ(ordered.moments[3][0].file, 1u);
}

TEST(MomentOrder, FilesOfSeveralProcessesAreTogether) {
    // Both went back from 300 to 200, as a parallel run that is continued does.
    const auto both =
        file_of({0, 100, 200, 300, 200, 300, 400}, 0) + file_of({0, 100, 200, 300, 200, 300, 400}, 1);
    const OrderedMoments ordered = in_order(both, processes);
    ASSERT_EQ(ordered.moments.size(), 5u);
    for (const auto& parts : ordered.moments) {
        ASSERT_EQ(parts.size(), 2u);
        EXPECT_EQ(parts[0].frame, parts[1].frame);
    }
    EXPECT_EQ(ordered.moments[2][0].frame, 4u);
    // A process without grains says nothing of its ids.
    auto empty = file_of({0, 100}, 1);
    for (PlacedMoment& one : empty) one.moment.grains = 0;
    const OrderedMoments with_empty = in_order(file_of({0, 100}, 0) + empty, one_run);
    ASSERT_EQ(with_empty.moments.size(), 2u);
    EXPECT_EQ(with_empty.moments[0].size(), 2u);
}

TEST(MomentOrder, TimesCountWhereThereAreNoSteps) {
    std::vector<PlacedMoment> all;
    for (const double time : {0.0, 0.1, 0.2, 0.3, 0.1 + 0.1, 0.25}) {
        PlacedMoment& one = all.emplace_back();
        one.moment.time = time;
        one.frame = all.size() - 1;
    }
    EXPECT_THAT(taken(all), ElementsAre(0, 1, 4, 5));
    for (PlacedMoment& one : all) one.moment.time.reset();
    EXPECT_THAT(taken(all), ElementsAre(0, 1, 2, 3, 4, 5));
}

}  // namespace
}  // namespace grainreel
