// Tests of runs that do not reach their end because of signals or a full disk. What they had must stay
// usable.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/base/error.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/grain_table.hpp"
#include "tests/cli/film_length.hpp"
#include "tests/cli/program.hpp"
#include "tests/cli/small_disk.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::HasSubstr;

// The program is halted meanwhile, so that both signals wait for it and it cannot begin an orderly end
// between them.
void send_both_at_once(Program& program) {
    for (const int signal : {SIGSTOP, SIGINT, SIGTERM, SIGCONT}) program.send(signal);
}

class StoppedMovie : public testing::Test {
  protected:
    // The command for an hour of shaking, in run/ of the test's folder.
    std::vector<std::string> long_run(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> words = {"movie", scene.string(), "--duration", "3600 s", "--out", "run"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }

    std::size_t frames_on_disk() const {
        try {
            return TrajectoryReader(here / "run/trajectory.nc").frames();
        } catch (const UserError&) {
            return 0;  // the file is not there yet
        }
    }

    nlohmann::json record() const { return nlohmann::json::parse(text_of(here / "run/run.json")); }

    TemporaryFolder here;
    fs::path scene = write_small_scene(here.path());
};

class SignalledMovie : public StoppedMovie, public testing::WithParamInterface<int> {};

TEST_P(SignalledMovie, EndsInGoodOrder) {
    Program program(long_run(), {here.path(), {}});
    ASSERT_TRUE(wait_until(program, [&] { return frames_on_disk() >= 5; }));
    program.send(GetParam());
    const Ended ended = program.wait();
    EXPECT_EQ(ended.status, 128 + GetParam()) << ended.err;
    EXPECT_EQ(ended.out, "run\n");
    EXPECT_EQ(record()["status"], "interrupted");
    EXPECT_EQ(record()["exit_status"], 128 + GetParam());
    EXPECT_EQ(decoded_pictures(here / "run/movie.mp4"), record()["written"]["film_frames"].get<int>());
    EXPECT_GT(record()["written"]["film_frames"].get<int>(), 0);
    EXPECT_GE(frames_on_disk(), 5u);
    EXPECT_EQ(read_grain_table(here / "run/final.csv").size(), 50u);
    EXPECT_TRUE(fs::exists(here / "run/checkpoint.grs"));
    // The end state has its row of measures.
    const std::string measures = text_of(here / "run/measures.csv");
    const std::size_t last_line = measures.rfind('\n', measures.size() - 2) + 1;
    EXPECT_EQ(std::stoll(measures.substr(last_line)), record()["engine"]["steps"].get<std::int64_t>());
}

INSTANTIATE_TEST_SUITE_P(Signals, SignalledMovie, testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const auto& signal) {
                             return signal.param == SIGINT    ? "Interrupt"
                                    : signal.param == SIGTERM ? "Terminate"
                                                              : "HangUp";
                         });

// A closed terminal sends SIGHUP twice: from the kernel and from the shell.
TEST_F(StoppedMovie, ASecondHangUpLeavesTheGoodOrder) {
    Program program(long_run(), {here.path(), {}});
    ASSERT_TRUE(wait_until(program, [&] { return frames_on_disk() >= 5; }));
    program.send(SIGHUP);
    ASSERT_TRUE(wait_until(
        program, [&] { return text_of(here / "run/log.txt").find("stopping") != std::string::npos; }));
    program.send(SIGHUP);
    EXPECT_EQ(program.wait().status, 129);
    EXPECT_EQ(record()["status"], "interrupted");
    EXPECT_EQ(decoded_pictures(here / "run/movie.mp4"), record()["written"]["film_frames"].get<int>());
}

TEST_F(StoppedMovie, GoesOnUnderNohup) {
    Program program(long_run({"--no-film"}), {.folder = here.path(), .hang_up_ignored = true});
    ASSERT_TRUE(wait_until(program, [&] { return frames_on_disk() >= 1; }));
    program.send(SIGHUP);
    const std::size_t then = frames_on_disk();
    ASSERT_TRUE(wait_until(program, [&] { return frames_on_disk() >= then + 3; }));
    program.send(SIGTERM);
    EXPECT_EQ(program.wait().status, 143);
}

// A run that was stopped is resumed from its checkpoint to 0.3 s; the state's hash is that of a run in one
// go.
void expect_goes_on(const fs::path& here) {
    std::string text = text_of(here / "run/scene.toml");
    write_text(here / "whole.toml", text);
    const std::size_t start = text.find("\n[start]") + 1;
    text.replace(start, text.find("\n[", start) - start,
                 "[start]\nmethod = \"file\"\nfile = \"run/checkpoint.grs\"\nkeep_clock = true\n");
    write_text(here / "continued.toml", text);
    std::vector<std::string> hashes;
    for (const std::string name : {"whole", "continued"}) {
        const Ended ended = run_program(
            {"movie", name + ".toml", "--no-film", "--duration", "0.3 s", "--out", name}, {here, {}});
        ASSERT_EQ(ended.status, 0) << ended.err;
        hashes.push_back(nlohmann::json::parse(text_of(here / name / "run.json"))["engine"]["state_hash"]);
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST_F(StoppedMovie, ASecondSignalKeepsTheStateAndLeavesTheFilm) {
    // Pictures are so large that the film is far behind.
    Program program(long_run({"--size", "1920x1080"}), {here.path(), {}});
    ASSERT_TRUE(wait_until(program, [&] { return frames_on_disk() >= 1; }));
    fs::remove(here / "run/checkpoint.grs");
    send_both_at_once(program);
    const Ended ended = program.wait();
    EXPECT_TRUE(ended.status == 130 || ended.status == 143) << ended.status;
    EXPECT_THAT(ended.err, tells({"film", "left as it is"}));
    EXPECT_EQ(record()["status"], "interrupted");
    EXPECT_EQ(record()["exit_status"], ended.status);
    EXPECT_EQ(read_grain_table(here / "run/final.csv").size(), 50u);
    EXPECT_FALSE(fs::exists(here / "run/poster.png"));
    EXPECT_TRUE(fs::exists(here / "run/checkpoint.grs"));
}

// There is no state yet, so the program has nothing to wait for.
TEST_F(StoppedMovie, ASecondSignalWhilePackingStopsAtOnce) {
    Program program(long_run({"--set", "species.small.count=150", "--set", "run.step=1e-7 s"}),
                    {here.path(), {}});
    ASSERT_TRUE(wait_until(program, [&] { return fs::exists(here / "run/scene.toml"); }));
    send_both_at_once(program);
    const Ended ended = program.wait();
    EXPECT_TRUE(ended.status == 130 || ended.status == 143) << ended.status;
    EXPECT_THAT(ended.err, tells({"stopped at once", "not yet on disk", "lost"}));
    EXPECT_EQ(record()["status"], "running");
}

// The first signal has stopped the run, and the film is being finished. With one thread, engine and film take
// turns, so many pictures wait to be drawn.
TEST_F(StoppedMovie, ASecondSignalWhilePicturesWaitLeavesTheFilmAndTellsItsLength) {
    for (const char* format : {"mp4", "gif"}) {
        Program program(long_run({"--size", "960x540", "--threads", "1", "--frames", "--format", format}),
                        {here.path(), {}});
        ASSERT_TRUE(wait_until(program, [&] { return fs::exists(here / "run/frames/000001.png"); }));
        program.send(SIGINT);
        ASSERT_TRUE(wait_until(program, [&] { return record()["status"] == "interrupted"; }));
        EXPECT_EQ(record()["written"]["film_frames"], nullptr);  // not known before the film is closed
        program.send(SIGINT);
        const Ended ended = program.wait();
        EXPECT_EQ(ended.status, 130);
        EXPECT_THAT(ended.err, tells({"film", "left as it is"}));
        EXPECT_THAT(ended.err, HasSubstr("made is in run"));
        EXPECT_EQ(record()["exit_status"], 130);
        const std::string film = std::string(format) == "mp4" ? "movie.mp4" : "movie.work/spool.mkv";
        const int frames = record()["written"]["film_frames"].get<int>();
        EXPECT_GE(frames, 1);
        EXPECT_EQ(decoded_pictures(here / "run" / film), frames);
        EXPECT_THAT(ended.err, HasSubstr(fmt::format("wrote run: {} ({} frames), ", film, frames)));
        EXPECT_EQ(read_grain_table(here / "run/final.csv").size(), 50u);
        fs::remove_all(here / "run");
    }
}

TEST_F(StoppedMovie, AThirdSignalWhilePicturesWaitEndsAtOnceAndSaysSo) {
    Program program(long_run({"--size", "960x540", "--threads", "1"}), {here.path(), {}});
    ASSERT_TRUE(wait_until(program, [&] { return fs::exists(here / "run/poster.png"); }));
    program.send(SIGINT);
    ASSERT_TRUE(wait_until(program, [&] { return record()["status"] == "interrupted"; }));
    program.send(SIGSTOP);  // so that the last two signals come together
    program.send(SIGINT);
    program.send(SIGTERM);
    program.send(SIGCONT);
    const Ended ended = program.wait();
    EXPECT_TRUE(ended.status == 130 || ended.status == 143) << ended.status;
    EXPECT_THAT(ended.err, tells({"stopped at once", "not yet on disk", "lost"}));
    EXPECT_EQ(record()["status"], "interrupted");
    EXPECT_EQ(record()["written"]["film_frames"], nullptr);
}

TEST_F(StoppedMovie, ACheckpointIsThereFromTheStart) {
    Program program(long_run({"--no-film"}), {here.path(), {}});
    ASSERT_TRUE(wait_until(program, [&] { return frames_on_disk() >= 1; }));
    program.send(SIGKILL);
    program.wait();
    expect_goes_on(here.path());
}

TEST_F(StoppedMovie, KilledLeavesAReadableTrajectoryAndFilm) {
    Program program(long_run(), {here.path(), {}});
    ASSERT_TRUE(wait_until(program, [&] { return decoded_pictures(here / "run/movie.mp4") >= 30; }));
    program.send(SIGKILL);
    EXPECT_EQ(program.wait().status, 128 + SIGKILL);
    EXPECT_EQ(record()["status"], "running");
    EXPECT_GE(decoded_pictures(here / "run/movie.mp4"), 30);
    const TrajectoryReader trajectory(here / "run/trajectory.nc");
    ASSERT_GE(trajectory.frames(), 2u);
    const State last = trajectory.read(trajectory.frames() - 1);
    EXPECT_EQ(last.size(), 50u);
    for (const Vec3& position : last.position) EXPECT_TRUE(position.allFinite());
}

TEST_F(StoppedMovie, InterruptedBeforeTheFirstStepKeepsTheOldRun) {
    fs::create_directory(here / "run");
    write_text(here / "run/run.json", "{}");
    write_text(here / "run/movie.mp4", "the old film");
    // There are so many stiff grains that packing takes a while.
    Program program(long_run({"--force", "--set", "species.small.count=150", "--set", "run.step=1e-7 s"}),
                    {here.path(), {}});
    ASSERT_TRUE(wait_until(program, [&] { return fs::exists(here / "run/scene.toml"); }));
    program.send(SIGINT);
    const Ended ended = program.wait();
    EXPECT_EQ(ended.status, 130);
    EXPECT_THAT(ended.err, tells({"to be replaced", "kept in .run.old-1"}));
    EXPECT_EQ(text_of(here / ".run.old-1/movie.mp4"), "the old film");
    EXPECT_EQ(record()["status"], "interrupted");
}

// A limit on the size of files stands for the full disk: the write that exceeds it fails.
TEST_F(StoppedMovie, AFullDiskEndsTheRunAndKeepsTheFramesBefore) {
    const Ended ended = run_program(long_run({"--no-film", "--set", "output.measures_interval=10 s"}),
                                    {here.path(), {}, 300000});
    EXPECT_EQ(ended.status, 1) << ended.err;
    EXPECT_THAT(ended.err, tells({"trajectory.nc", "cannot be written", "File too large"}));
    EXPECT_EQ(record()["status"], "failed");
    EXPECT_EQ(record()["exit_status"], 1);
    EXPECT_THAT(record()["error"], HasSubstr("cannot be written"));
    const TrajectoryReader trajectory(here / "run/trajectory.nc");
    ASSERT_GE(trajectory.frames(), 10u);
    EXPECT_EQ(trajectory.frames(), record()["written"]["trajectory_frames"].get<std::size_t>());
    double time = -1;
    for (std::size_t i = 0; i < trajectory.frames(); ++i) {
        const State frame = trajectory.read(i);
        EXPECT_EQ(frame.size(), 50u);
        EXPECT_GT(frame.time, time);
        time = frame.time;
    }
    EXPECT_EQ(read_grain_table(here / "run/final.csv").size(), 50u);
}

// The disk is so full that no new file can be made. run.json still tells it.
TEST_F(StoppedMovie, AFullDiskIsWrittenDownInRunJson) {
    fs::create_directory(here / "disk");
    const SmallDisk disk(here / "disk", 300000);
    if (!disk.mounted()) GTEST_SKIP() << "no disk of its own can be mounted here";
    const Ended ended = run_program({"movie", scene.string(), "--duration", "3600 s", "--no-film", "--out",
                                     "disk/run", "--set", "output.measures_interval=10 s"},
                                    {here.path(), {}});
    EXPECT_EQ(ended.status, 1) << ended.err;
    const auto written = nlohmann::json::parse(text_of(here / "disk/run/run.json"));
    EXPECT_EQ(written["status"], "failed");
    EXPECT_EQ(written["exit_status"], 1);
    EXPECT_THAT(written["error"], tells({"cannot be written", "No space left"}));
    const TrajectoryReader trajectory(here / "disk/run/trajectory.nc");
    EXPECT_EQ(trajectory.frames(), written["written"]["trajectory_frames"].get<std::size_t>());
    EXPECT_GT(trajectory.frames(), 0u);
}

TEST_F(StoppedMovie, AFolderThatIsGoneEndsTheRun) {
    for (const char* without : {"output.trajectory=true", "output.trajectory=false"}) {
        Program program(long_run({"--no-film", "--set", without, "--set", "output.measures_interval=10 s"}),
                        {here.path(), {}});
        ASSERT_TRUE(wait_until(program, [&] { return fs::exists(here / "run/checkpoint.grs"); }));
        fs::rename(here / "run", here / "moved");
        fs::remove_all(here / "moved");
        const Ended ended = program.wait();
        EXPECT_EQ(ended.status, 1);
        EXPECT_THAT(ended.err, tells({"run: ", "folder is gone", "removed or renamed"}));
        EXPECT_FALSE(fs::exists(here / "run"));
    }
}

// The run's files continue in its present place; a folder that somebody else has put in the old place is not
// touched.
TEST_F(StoppedMovie, AFolderThatIsRenamedAndReplacedEndsTheRun) {
    for (const bool film : {true, false}) {
        Program program(
            long_run(film ? std::vector<std::string>{"--frames"} : std::vector<std::string>{"--no-film"}),
            {here.path(), {}});
        ASSERT_TRUE(wait_until(program, [&] { return frames_on_disk() >= 3; }));
        program.send(SIGSTOP);
        fs::rename(here / "run", here / "moved");
        fs::create_directory(here / "run");
        write_text(here / "run/.lock", "of another");
        program.send(SIGCONT);
        const Ended ended = program.wait();
        EXPECT_EQ(ended.status, 1);
        const std::string message = "run: the run's folder was renamed to moved while the run went on";
        EXPECT_THAT(ended.err, HasSubstr("error: " + message + "\n"));
        EXPECT_THAT(ended.err, tells({"made until then", "in moved"}));
        EXPECT_EQ(ended.out, "moved\n");
        EXPECT_EQ(text_of(here / "run/.lock"), "of another");
        fs::remove(here / "run/.lock");
        EXPECT_TRUE(fs::is_empty(here / "run"));
        const auto told = nlohmann::json::parse(text_of(here / "moved/run.json"));
        EXPECT_EQ(told["status"], "failed");
        EXPECT_EQ(told["error"], message);
        EXPECT_EQ(read_grain_table(here / "moved/final.csv").size(), 50u);
        EXPECT_TRUE(fs::exists(here / "moved/checkpoint.grs"));
        EXPECT_FALSE(fs::exists(here / "moved/.lock"));
        if (film) {
            EXPECT_EQ(decoded_pictures(here / "moved/movie.mp4"), told["written"]["film_frames"].get<int>());
        }
        fs::remove_all(here / "run");
        fs::remove_all(here / "moved");
    }
}

TEST_F(StoppedMovie, AFolderThatIsRemovedAndMadeAnewIsLeftAlone) {
    Program program(long_run(), {here.path(), {}});
    ASSERT_TRUE(wait_until(program, [&] { return frames_on_disk() >= 3; }));
    program.send(SIGSTOP);
    fs::rename(here / "run", here / "moved");
    fs::create_directory(here / "run");
    fs::remove_all(here / "moved");
    program.send(SIGCONT);
    const Ended ended = program.wait();
    EXPECT_EQ(ended.status, 1);
    EXPECT_THAT(ended.err, tells({"error: run", "no longer", "removed or replaced", "nothing more"}));
    EXPECT_EQ(ended.out, "");
    EXPECT_TRUE(fs::is_empty(here / "run"));
    EXPECT_FALSE(fs::exists(here / "moved"));
}

// Each panel of a comparison has a folder of its own.
TEST_F(StoppedMovie, AComparisonThatIsRenamedKeepsItsPanels) {
    Program program({"compare", scene.string(), scene.string(), "--duration", "3600 s", "--out", "run",
                     "--size", "640x360", "--captions", "a|b"},
                    {here.path(), {}});
    // The film is the last file that is opened, after both panels have begun.
    ASSERT_TRUE(wait_until(program, [&] {
        return fs::exists(here / "run/movie.mp4") && fs::exists(here / "run/fifty-2/checkpoints");
    }));
    program.send(SIGSTOP);
    fs::rename(here / "run", here / "moved");
    fs::create_directory(here / "run");
    program.send(SIGCONT);
    const Ended ended = program.wait();
    EXPECT_EQ(ended.status, 1);
    EXPECT_THAT(ended.err, HasSubstr("renamed to moved"));
    EXPECT_TRUE(fs::is_empty(here / "run"));
    for (const char* panel : {"fifty", "fifty-2"}) {
        EXPECT_EQ(read_grain_table(here / "moved" / panel / "final.csv").size(), 50u);
        const auto told = nlohmann::json::parse(text_of(here / "moved" / panel / "run.json"));
        EXPECT_TRUE(told["status"] == "failed" || told["status"] == "interrupted") << told["status"];
    }
}

TEST_F(StoppedMovie, AFolderInUseIsLeftAlone) {
    Program program(long_run({"--no-film"}), {here.path(), {}});
    ASSERT_TRUE(wait_until(program, [&] { return frames_on_disk() >= 2; }));
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"movie", scene.string(), "--out", "run"},
             {"movie", scene.string(), "--out", "run", "--force"},
             {"compare", scene.string(), scene.string(), "--size", "640x360", "--out", "run", "--force"}}) {
        const Ended refused = run_program(words, {here.path(), {}});
        EXPECT_EQ(refused.status, 2);
        EXPECT_THAT(refused.err, tells({"error: --out run", "in use", "process"}));
        EXPECT_THAT(refused.err, HasSubstr("--duration '3600 s'"));  // the command of the run
    }
    // Reading in that folder is allowed.
    EXPECT_EQ(run_program({"render", "run", "--at", "0", "--out", "still.png"}, {here.path(), {}}).status, 0);
    program.send(SIGINT);
    EXPECT_EQ(program.wait().status, 130);
    EXPECT_EQ(record()["status"], "interrupted");
    EXPECT_FALSE(fs::exists(here / "run/.lock"));
    EXPECT_EQ(
        run_program({"movie", scene.string(), "--no-film", "--out", "run", "--force"}, {here.path(), {}})
            .status,
        0);
}

TEST_F(StoppedMovie, AFilmThatCannotGrowEndsTheRunToo) {
    const Ended ended =
        run_program(long_run({"--set", "output.trajectory=false", "--set", "output.measures_interval=10 s"}),
                    {here.path(), {}, 100000});
    EXPECT_EQ(ended.status, 1) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("movie"));
    EXPECT_GT(decoded_pictures(here / "run/movie.mp4"), 0);
    EXPECT_EQ(read_grain_table(here / "run/final.csv").size(), 50u);
}

}  // namespace
}  // namespace grainreel
