// Jobs that end early, by run.sh under MPI: a rank that is killed, and a signal to the script as a cluster
// sends it. What there is comes back.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <chrono>
#include <thread>

#include "engine/handover/bring_back.hpp"
#include "engine/handover/decks/decks.hpp"
#include "engine/handover/peer_process.hpp"
#include "tests/engines/handed.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// It would take half an hour.
constexpr const char* kLong = R"([drive]
frequency = "20 Hz"
g_level = 3
[output]
trajectory_interval = "4 ms"
[run]
duration = "400 s"
step = 4e-5
)";

class EarlyEnd : public testing::TestWithParam<PeerEngine> {
  protected:
    void SetUp() override {
        NEEDS_ENGINE(GetParam());
        CarryRequest request;
        request.engine = GetParam();
        request.ranks = 2;
        hand_over(balls_in_box(0.7, 0.3, kLong), request, folder_.path());
        std::string script = (folder_ / "run.sh").string(), shell = "sh";
        char* words[] = {shell.data(), script.data(), nullptr};
        ASSERT_EQ(::posix_spawnp(&job_, "sh", nullptr, nullptr, words, environ), 0);
        DeckDump dump(folder_ / dump_name(GetParam()));
        for (int frames = 0; frames < 5 && runs();) {
            if (dump.next())
                ++frames;
            else
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        ASSERT_TRUE(runs()) << text_of(folder_ / output_name(GetParam()));
    }
    void TearDown() override {
        if (job_ > 0 && runs()) ::kill(job_, SIGTERM), wait();
    }

    bool runs() { return status_ < 0 && ::waitpid(job_, &status_, WNOHANG) == 0; }
    int wait() {
        if (status_ < 0) ::waitpid(job_, &status_, 0);
        return WEXITSTATUS(status_);
    }
    // The processes of the engine, which work in the folder.
    std::vector<pid_t> ranks() const {
        std::vector<pid_t> all;
        const std::string name = GetParam() == PeerEngine::lammps ? "lmp\n" : "liggghts\n";
        std::error_code gone;
        for (const fs::directory_entry& one : fs::directory_iterator("/proc", gone))
            if (fs::read_symlink(one.path() / "cwd", gone) == fs::canonical(folder_.path()) &&
                text_of(one.path() / "comm") == name)
                all.push_back(std::stoi(one.path().filename().string()));
        return all;
    }
    BroughtBack back() const {
        return bring_back(folder_.path(), "test", [](double) { return true; });
    }

    const TemporaryFolder folder_;
    pid_t job_ = -1;
    int status_ = -1;
};

TEST_P(EarlyEnd, ARankThatIsKilledLeavesWhatThereIs) {
    const std::vector<pid_t> all = ranks();
    ASSERT_EQ(all.size(), 2u);
    ::kill(all.front(), SIGKILL);
    EXPECT_EQ(wait(), 137);
    EXPECT_THAT(text_of(folder_ / status_name), testing::StartsWith("137\njob "));
    const BroughtBack run = back();
    EXPECT_GE(run.frames, 5);
    EXPECT_FALSE(run.whole);
    ASSERT_EQ(run.news.size(), 1u);
    EXPECT_THAT(run.news[0], HasSubstr(fmt::format("{} was ended by signal 9", name_of(GetParam()))));
    EXPECT_THAT(run.news[0], HasSubstr(fmt::format("{:.4g} s of 400 s; what there is is shown", run.until)));
}

// The ranks end with the script. LIGGGHTS then writes a restart file of that moment, from which it goes on.
// It does not always come to it: its ranks may see the signal at different steps and then wait for each
// other, until Open MPI kills them after a second.
TEST_P(EarlyEnd, ASignalToTheScriptEndsTheRanks) {
    ::kill(job_, SIGTERM);
    EXPECT_EQ(wait(), 143);
    EXPECT_THAT(text_of(folder_ / status_name), testing::StartsWith("143\njob "));
    EXPECT_TRUE(ranks().empty());
    const HandoverFacts facts = read_handover(folder_.path());
    EXPECT_TRUE(job_end(folder_.path(), facts).ended);
    EXPECT_THAT(job_end(folder_.path(), facts).failure, tells({"asked to end", "signal"}));
    EXPECT_GE(back().frames, 5);
    if (GetParam() == PeerEngine::lammps) return;
    for (const fs::directory_entry& one : fs::directory_iterator(folder_.path()))
        EXPECT_FALSE(one.path().filename().string().starts_with(forced_begin)) << one.path();
    const std::optional<std::int64_t> restart = newest_restart(folder_.path(), GetParam());
    EXPECT_EQ(restart.has_value(),
              text_of(folder_ / output_name(GetParam())).find(forced_words) != std::string::npos);
    if (!restart) return;
    EXPECT_GE(*restart, frames_of(GetParam(), folder_.path()).rbegin()->first);
    EXPECT_LT(*restart, 1000000);  // the deck's own are each 10^6 steps
}

INSTANTIATE_TEST_SUITE_P(Both, EarlyEnd, testing::Values(PeerEngine::lammps, PeerEngine::liggghts),
                         [](const auto& engine) { return std::string(key_of(engine.param)); });

}  // namespace
}  // namespace grainreel::test
