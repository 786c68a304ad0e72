// Tests of `grainreel check` as its users meet it: what it refuses at once, and what ends it.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "tests/cli/mesh_scene.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::HasSubstr;
using testing::Not;

class CheckProgram : public testing::Test {
  protected:
    // Its own cache is empty, so the machine is measured anew. All others share one.
    Program::Setting with_own_cache() const {
        return {here.path(), {"XDG_CACHE_HOME=" + here.path().string()}};
    }
    Ended check(std::vector<std::string> words) const {
        words.insert(words.begin(), "check");
        return run_program(words, {here.path()});
    }
    Ended check_small(std::vector<std::string> words) const {  // shipped films are large
        words.insert(words.end(), {"--size", "160x90"});
        return check(words);
    }

    TemporaryFolder here;
    fs::path scene = write_small_scene(here.path());
};

TEST_F(CheckProgram, ReadsNoFurtherThanASceneMayGo) {
    const Ended device = check({"/dev/zero"});
    EXPECT_EQ(device.status, 2);
    EXPECT_THAT(device.err, tells({"/dev/zero", "device", "path"}));
    write_text(here / "large.toml", "");
    fs::resize_file(here / "large.toml", (16 << 20) + 1);
    const Ended large = check({"large.toml"});
    EXPECT_EQ(large.status, 2);
    EXPECT_THAT(large.err, tells({"large.toml", "larger", "16 MiB"}));
}

TEST_F(CheckProgram, ReadsAPipe) {
    const fs::path pipe = here / "pipe.toml";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::thread writer([&] { write_text(pipe, small_scene_text); });
    const Ended ended = check({pipe.string()});
    writer.join();
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("Fifty grains"));
}

TEST_F(CheckProgram, NamesOnlyWhatIsKept) {
    const auto kept = [&](const std::string& set) { return check({"fifty.toml", "--set", set}).out; };
    EXPECT_THAT(kept("output.film_moments=true"), HasSubstr("comes back: checkpoints up to "));
    EXPECT_THAT(kept("output.film_moments=true"), HasSubstr(", moments of the film "));
    EXPECT_THAT(kept("output.film_moments=false"), HasSubstr("comes back: checkpoints up to "));
    EXPECT_THAT(kept("output.film_moments=false"), Not(HasSubstr("moments of the film")));
    EXPECT_THAT(kept("output.checkpoints=none"), tells({"comes back", "moments of"}));
}

// With a given damping every size has a restitution of its own; a given restitution holds for all sizes.
TEST_F(CheckProgram, TellsTheRestitutionOfAllSizes) {
    const std::string spread = "species.small.diameter={ min = \"1 mm\", max = \"4 mm\" }";
    const auto contacts = [&](const char* more) {
        return check({scene.string(), "--set", spread, "--set", "contact.law=spring-dashpot", "--set",
                      "contact.stiffness=1e4", "--set", more})
            .out;
    };
    EXPECT_THAT(contacts("contact.normal_damping=2000"),
                testing::ContainsRegex("small - small +1e\\+04 N/m +the scene +0\\.[0-9]+ to 0\\.[0-9]+ "));
    EXPECT_THAT(contacts("contact.restitution=0.5"),
                testing::ContainsRegex("small - small +1e\\+04 N/m +the scene +0\\.5 "));
}

TEST_F(CheckProgram, ABoxThatIsOnlyFedIsNotPacked) {
    write_text(here / "fed.toml", fed_scene_text);
    const Ended ended = check({"fed.toml"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.out, tells({"empty", "[[feed]]"}));
}

// A pipe that stays silent holds the program in the middle of its work. If the signal did not end it, the
// closed pipe would, with a message about an empty scene.
class SignalledCheck : public CheckProgram, public testing::WithParamInterface<int> {};

TEST_P(SignalledCheck, EndsAtOnce) {
    const fs::path pipe = here / "pipe.toml";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    Program program({"check", pipe.string()}, {here.path()});
    int end = -1;  // the pipe can be opened as soon as the program reads
    ASSERT_TRUE(
        wait_until(program, [&] { return (end = ::open(pipe.c_str(), O_WRONLY | O_NONBLOCK)) >= 0; }));
    program.send(GetParam());
    ::close(end);
    EXPECT_EQ(program.wait().status, 128 + GetParam());
}

INSTANTIATE_TEST_SUITE_P(Signals, SignalledCheck, testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const auto& signal) {
                             return signal.param == SIGINT    ? "Interrupt"
                                    : signal.param == SIGTERM ? "Terminate"
                                                              : "HangUp";
                         });

// The signal comes while the program measures the cost of a frame, whose film lies in a folder of its own.
TEST_P(SignalledCheck, LeavesNothingBehind) {
    const fs::path temporary = here / "tmp";
    fs::create_directory(temporary);
    Program::Setting there = with_own_cache();
    there.environment.push_back("TMPDIR=" + temporary.string());
    Program program({"check", scene.string(), "--size", "1920x1080"}, there);
    ASSERT_TRUE(wait_until(program, [&] { return !fs::is_empty(temporary); }));
    program.send(GetParam());
    EXPECT_EQ(program.wait().status, 128 + GetParam());
    EXPECT_TRUE(fs::is_empty(temporary));
}

// Numbers are computed before anything is made: each of these took minutes or gigabytes, or had no end.
TEST_F(CheckProgram, RefusesMoreThanCanBeMade) {
    const auto complaint = [&](const std::vector<std::string>& words) {
        std::vector<std::string> all = {scene.string()};
        all.insert(all.end(), words.begin(), words.end());
        const Ended ended = check(all);
        EXPECT_EQ(ended.status, 2);
        return ended.err;
    };
    const std::vector<std::string> long_run = {"--duration", "1e9", "--set", "output.trajectory=false"};
    EXPECT_THAT(complaint({"--duration", "1e9"}),
                tells({"2e+10 frames", "trajectory", "1e+09", "lengthen 'output.trajectory_interval'",
                       "'run.duration'"}));
    EXPECT_THAT(complaint(long_run), tells({"1.6e+11 rows", "measures", "1e+09"}));
    EXPECT_THAT(complaint({"--duration", "1e9", "--set", "output.trajectory=false", "--set",
                           "output.measures_interval=10 s"}),
                tells({"film", "6e+10 frames", "10000000", "raise 'film.segment[0].playback'", "0.5",
                       "'run.duration'"}));
    EXPECT_THAT(complaint({"--duration", "1e6", "--set", "film.segment[0].playback=1e-320", "--set",
                           "output.measures_interval=1 s"}),
                tells({"raise 'film.segment[0].playback'", "1e-320", "'run.duration'"}));
}

TEST_F(CheckProgram, TakesAnyPlaybackAndFrequency) {
    for (const char* set : {"film.segment[0].playback=1e16", "film.segment[0].playback=1e-320"}) {
        const Ended ended = check({scene.string(), "--set", set});
        EXPECT_EQ(ended.status, 0) << set << ' ' << ended.err;
    }
    const Ended ended = check({scene.string(), "--set", "drive.frequency=1e8 Hz", "--set",
                               "film.segment[0].kind=locked", "--set", "film.segment[0].playback=1"});
    EXPECT_EQ(ended.status, 2);
}

TEST_F(CheckProgram, StatesTheSpeedThatIsPlayed) {
    const Ended ended = check({scene.string(), "--set", "film.segment[0].playback=1e-5"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.out, testing::Not(HasSubstr("1/100000 speed")));
    EXPECT_THAT(ended.out, tells({"every step once", "plays at"}));
}

std::string line_with(const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

// The machine is measured once: the second answer is the same as the first, to the digit.
TEST_F(CheckProgram, KeepsWhatItMeasuredOfTheMachine) {
    const auto measured = [&] { return run_program({"check", scene.string()}, with_own_cache()); };
    const Ended first = measured(), second = measured();
    EXPECT_EQ(first.status, 0) << first.err;
    EXPECT_EQ(std::distance(fs::directory_iterator(here / "grainreel"), {}), 1);
    EXPECT_NE(line_with(first.out, "together about"), "");
    for (const char* line : {"together about", "for the film", "grain-steps,"})
        EXPECT_EQ(line_with(first.out, line), line_with(second.out, line));
    const Ended nowhere = run_program({"check", scene.string()}, {here.path(), {"XDG_CACHE_HOME=/dev/null"}});
    EXPECT_EQ(nowhere.status, 0) << nowhere.err;
}

TEST_F(CheckProgram, TellsWhatEachMeshIsAndWhatWasMended) {
    write_mesh_scene(here.path());
    const Ended ended = check({"plate.toml"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    for (const char* line :
         {"plate: plate.stl, ASCII STL, 2 triangles, 200 mm x 200 mm x 0 mm from (-0.1, -0.1, 0) to (0.1, "
          "0.1, 0) m",
          "1 part, open: 4 edges of one triangle alone", "stands still",
          "paddle: plate.obj, OBJ, 2 triangles, 200 mm x 200 mm x 0 mm", "scaled by 0.001", "mended: ",
          "turns at 30 rpm about the axis (0, 0, 1) through (0, 0, 0) m, from 0.01 s, begun over 0.02 s",
          "ball - plate", "ball - paddle"})
        EXPECT_THAT(ended.out, HasSubstr(line));
    EXPECT_THAT(ended.out, Not(HasSubstr("ball - wall"))) << "there is none";
    const std::size_t first = ended.out.find("mended: ");
    ASSERT_NE(first, std::string::npos);
    const std::string words = ended.out.substr(first + 8, ended.out.find('\n', first) - first - 8);
    EXPECT_EQ(ended.out.find(words, first + 8 + words.size()), std::string::npos) << ended.out;
}

// A plate of 200 m is beside grains of 10 mm.
TEST_F(CheckProgram, HintsAtMillimetres) {
    write_mesh_scene(here.path());
    const Ended small = check({"plate.toml"});
    EXPECT_THAT(small.out, Not(HasSubstr("scale = 0.001")));
    const Ended large = check({"plate.toml", "--set", "mesh.plate.file=plate.obj"});
    EXPECT_EQ(large.status, 0) << large.err;
    EXPECT_THAT(large.out + large.err, HasSubstr("scale = 0.001"));
}

TEST_F(CheckProgram, SetsKeysOfAMeshByNameAndByNumber) {
    write_mesh_scene(here.path());
    const Ended ended =
        check({"plate.toml", "--set", "mesh.paddle.turn.rate=60 rpm", "--set", "mesh.0.scale=0.5"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("turns at 60 rpm"));
    EXPECT_THAT(ended.out, HasSubstr("plate: plate.stl, ASCII STL, 2 triangles, 100 mm x 100 mm x 0 mm"));
}

// One large grain among many small ones is seen only through them.
TEST_F(CheckProgram, GivesAHintForAGrainThatMayBeHidden) {
    const Ended hidden = check_small({"teaching_brazil_nut", "--set", "film.ghost=[]"});
    EXPECT_EQ(hidden.status, 0) << hidden.err;
    EXPECT_THAT(hidden.out, tells({"hint", "\"nut\"", "film.ghost = [\"grains\"]"}));
    EXPECT_THAT(check_small({"teaching_brazil_nut"}).out, Not(HasSubstr("hint ")));
    EXPECT_THAT(check_small({"teaching_brazil_nut", "--set", "film.ghost=[]", "--set", "film.cut.at=0"}).out,
                Not(HasSubstr("hint ")));
    EXPECT_THAT(check_small({"teaching_sorting", "--set", "film.ghost=[]"}).out, Not(HasSubstr("hint ")));
}

}  // namespace
}  // namespace grainreel
