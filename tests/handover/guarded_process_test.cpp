// Processes that do not outlive us, whatever ends us: shown with a shell that starts others.
#include "engine/handover/guarded_process.hpp"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/handover/peer_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {
namespace {

namespace fs = std::filesystem;

// Until it holds, or for a minute.
bool comes(const std::function<bool()>& what) {
    for (int k = 0; k < 6000; ++k) {
        if (what()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

// Running, and no zombie that waits for its parent.
bool lives(pid_t process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string number, name, state;
    return file >> number >> name >> state && state != "Z";
}

// A shell with two others; one has a session of its own and laughs at SIGTERM. It tells their numbers.
const char* const kFamily =
    "setsid sh -c 'trap \"\" TERM; echo $$; while :; do sleep 0.1; done' & sleep 1000 & echo $!; echo $$; "
    "touch ready; wait";

std::vector<std::string> shell(const std::string& what) {
    return {"/bin/sh", "-c", what};
}

std::vector<pid_t> family_of(const fs::path& folder) {
    std::istringstream text(text_of(folder / "out"));
    std::vector<pid_t> all;
    for (pid_t one = 0; text >> one;) all.push_back(one);
    return all;
}

bool is_born(const fs::path& folder) {
    return fs::exists(folder / "ready") && family_of(folder).size() == 3;
}

bool all_are_gone(const std::vector<pid_t>& family) {
    for (const pid_t one : family)
        if (lives(one)) return false;
    return true;
}

TEST(GuardedProcess, GivesTheExitStatusAndWhatWasSaid) {
    const TemporaryFolder folder;
    GuardedProcess process(shell("echo out; echo err >&2; pwd; exit 7"), folder.path(),
                           folder.path() / "out");
    ASSERT_TRUE(comes([&] { return process.status().has_value(); }));
    EXPECT_EQ(process.status(), 7);
    EXPECT_EQ(text_of(folder.path() / "out"), "out\nerr\n" + fs::canonical(folder.path()).string() + "\n");
}

TEST(GuardedProcess, ASignalIsAStatusToo) {
    const TemporaryFolder folder;
    GuardedProcess process(shell("kill -9 $$"), folder.path(), folder.path() / "out");
    ASSERT_TRUE(comes([&] { return process.status().has_value(); }));
    EXPECT_EQ(process.status(), 128 + SIGKILL);
}

TEST(GuardedProcess, StopEndsAllThatItHasStarted) {
    const TemporaryFolder folder;
    GuardedProcess process(shell(kFamily), folder.path(), folder.path() / "out");
    ASSERT_TRUE(comes([&] { return is_born(folder.path()); }));
    const std::vector<pid_t> family = family_of(folder.path());
    process.stop();
    EXPECT_TRUE(comes([&] { return process.status().has_value(); }));
    EXPECT_TRUE(all_are_gone(family));
}

TEST(GuardedProcess, WhatTheProgramLeavesBehindEndsWithIt) {
    const TemporaryFolder folder;
    GuardedProcess process(shell("sleep 1000 & echo $!"), folder.path(), folder.path() / "out");
    ASSERT_TRUE(comes([&] { return process.status().has_value(); }));
    EXPECT_EQ(process.status(), 0);
    EXPECT_TRUE(all_are_gone(family_of(folder.path())));
}

// kill -9 to whoever started it.
TEST(GuardedProcess, NothingOutlivesAProcessThatIsKilled) {
    const TemporaryFolder folder;
    const pid_t owner = ::fork();
    if (owner == 0) {
        const GuardedProcess process(shell(kFamily), folder.path(), folder.path() / "out");
        while (true) ::pause();
    }
    ASSERT_TRUE(comes([&] { return is_born(folder.path()); }));
    const std::vector<pid_t> family = family_of(folder.path());
    for (const pid_t one : family) EXPECT_TRUE(lives(one));
    ::kill(owner, SIGKILL);
    ::waitpid(owner, nullptr, 0);
    EXPECT_TRUE(comes([&] { return all_are_gone(family); }));
}

TEST(EngineProgram, VersionsAreRead) {
    EXPECT_EQ(version_in(
                  PeerEngine::lammps,
                  "\nLarge-scale Atomic/Molecular Massively Parallel Simulator - 29 Sep 2021 - Update 2\n\n"),
              "29 Sep 2021 - Update 2");
    EXPECT_EQ(
        version_in(PeerEngine::liggghts,
                   "LIGGGHTS (Version LIGGGHTS-PUBLIC 3.8.0, compiled 2022-01-26-19:42:32 by buildd)\n"),
        "3.8.0");
    EXPECT_EQ(version_in(PeerEngine::lammps, "another program\n"), "");
}

TEST(EngineProgram, TheVersionWhoseWallsIgnoreGroupsIsRefused) {
    EXPECT_NO_THROW(check_version(PeerEngine::lammps, "29 Sep 2021 - Update 2"));
    EXPECT_THROW(check_version(PeerEngine::lammps, "28 Mar 2023 - Update 1"), UserError);
}

TEST(EngineWords, AnErrorIsQuotedWithTheDecksLine) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "in.x")
        << "units si\natom_style   sphere  # a comment\npair_style nosuch $x\n";
    std::ofstream(folder.path() / "out") << "LAMMPS\nunits si\natom_style sphere\npair_style nosuch $x\n"
                                         << "pair_style nosuch 3\nERROR: Unrecognized pair style 'nosuch'\n"
                                         << "Last command: pair_style nosuch $x\n";
    EXPECT_EQ(engine_error(folder.path() / "out", folder.path() / "in.x"),
              "in.x:3: ERROR: Unrecognized pair style 'nosuch' (at `pair_style nosuch $x`)");
    std::ofstream(folder.path() / "out") << "LAMMPS\nunits si\n";
    EXPECT_EQ(engine_error(folder.path() / "out", folder.path() / "in.x"), "");
}

}  // namespace
}  // namespace grainreel::test
