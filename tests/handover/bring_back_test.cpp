// How a job ended, restart files that a signal made, and the folder in which a run is made while its dump is
// read.
#include "engine/handover/bring_back.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/handover/decks/decks.hpp"
#include "engine/handover/peer_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {
namespace {

namespace fs = std::filesystem;

TEST(ReturningFolders, BelongToOneProcessAndAreEmpty) {
    const TemporaryFolder job;
    fs::create_directory(job / ".returning");
    write_text(job / ".returning/trajectory.nc", "of a process that was killed");
    {
        const auto mine = ReturningFolder::take(job.path());
        ASSERT_TRUE(mine);
        EXPECT_FALSE(fs::exists(mine->path() / "trajectory.nc"));
        EXPECT_FALSE(ReturningFolder::take(job.path()));
        EXPECT_TRUE(ReturningFolder::take(job.path(), ".following-2"));
        write_text(mine->path() / "measures.csv", "new");
        write_text(job / "measures.csv", "old");
        mine->move_out();
    }
    EXPECT_EQ(text_of(job / "measures.csv"), "new");
    EXPECT_FALSE(fs::exists(job / ".returning"));
    EXPECT_FALSE(fs::exists(job / ".following-2"));
    EXPECT_TRUE(ReturningFolder::take(job.path()));
}

// LIGGGHTS says once the file is whole.
TEST(ForcedRestarts, GoByTheUsualNameWhereTheyAreWhole) {
    for (const bool whole : {true, false}) {
        const TemporaryFolder job;
        write_text(job / "liggghts.restart.1000", "");
        write_text(job / "restart_forced_liggghts_1765.data", "");
        write_text(job / "out.liggghts",
                   fmt::format("SIGINT/SIGTERM caught - Writing restart on next occasion and quitting after "
                               "that.\n{}",
                               whole ? "WARNING: Forced restart written (./src/output.cpp:427)\n" : ""));
        take_forced_restarts(job.path(), job / "out.liggghts");
        EXPECT_EQ(newest_restart(job.path(), PeerEngine::liggghts), whole ? 1765 : 1000);
        EXPECT_FALSE(fs::exists(job / "restart_forced_liggghts_1765.data"));
    }
}

class JobEnds : public testing::TestWithParam<PeerEngine> {
  protected:
    JobEnds() { facts_.engine = GetParam(); }
    JobEnd end() const { return job_end(job_.path(), facts_); }
    std::string name() const { return name_of(GetParam()); }

    const TemporaryFolder job_;
    HandoverFacts facts_;
};

TEST_P(JobEnds, AreKnownByTheStatusThatRunShLeaves) {
    EXPECT_FALSE(end().ended);
    write_text(job_ / status_name, "0\n");
    EXPECT_TRUE(end().ended);
    EXPECT_EQ(end().failure, "");
    write_text(job_ / status_name, "137\n");
    EXPECT_EQ(end().failure, fmt::format("{} was ended by signal 9; its output is in {}", name(),
                                         (job_ / output_name(GetParam())).string()));
}

TEST_P(JobEnds, QuoteTheEnginesErrorWithTheLineOfTheDeck) {
    write_text(job_ / status_name, "1\n");
    write_text(job_ / deck_name(GetParam()), "units si\nrun 5\n");
    write_text(job_ / log_name(GetParam()), "units si\nrun 5\nERROR: Lost atoms (thermo.cpp:438)\n");
    EXPECT_EQ(end().failure, fmt::format("{} ended: {}:2: ERROR: Lost atoms (thermo.cpp:438) (at `run 5`)",
                                         name(), deck_name(GetParam())));
}

INSTANTIATE_TEST_SUITE_P(Both, JobEnds, testing::Values(PeerEngine::lammps, PeerEngine::liggghts),
                         [](const auto& engine) { return std::string(key_of(engine.param)); });

}  // namespace
}  // namespace grainreel::test
