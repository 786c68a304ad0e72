// Tests of `grainreel movie` as a user sees it: what it writes, prints and refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/files/trajectory/trajectory.hpp"
#include "engine/grain_table.hpp"
#include "engine/measure/columns.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene_file.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/cli/film_length.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::HasSubstr, testing::IsEmpty, testing::Not;

nlohmann::json record_of(const fs::path& run) {
    return nlohmann::json::parse(text_of(run / "run.json"));
}

std::int64_t lines_of(const fs::path& file) {
    const std::string text = text_of(file);
    return std::count(text.begin(), text.end(), '\n');
}

class MovieProgram : public testing::Test {
  protected:
    // Runs `grainreel movie SCENE words...` in the test's folder.
    Ended movie(std::vector<std::string> words, const std::vector<std::string>& environment = {}) {
        words.insert(words.begin(), {"movie", scene.string()});
        return run_program(words, {here.path(), environment});
    }

    TemporaryFolder here;
    fs::path scene = write_small_scene(here.path());
};

// Means and exposures need moments of their own. The run and its files do not change.
TEST_F(MovieProgram, MeansAndExposuresLeaveTheRunAlone) {
    ASSERT_EQ(movie({"--no-film", "--out", "plain"}).status, 0);
    const std::string segments =
        "film.segment=[{kind=\"locked\", average=2, duration=\"0.1 s\"}, {exposure=\"40 ms\", exposures=5}]";
    ASSERT_EQ(movie({"--set", segments, "--set", "film.text=\"{kinetic:mJ}\"", "--frames", "--out", "spans"})
                  .status,
              0);
    EXPECT_EQ(record_of(here / "spans")["engine"]["state_hash"],
              record_of(here / "plain")["engine"]["state_hash"]);
    for (const char* file : {"trajectory.nc", "measures.csv", "final.csv"})
        EXPECT_TRUE(text_of(here / "spans" / file) == text_of(here / "plain" / file)) << file;
    EXPECT_THAT(text_of(here / "spans/frames/000001.png"), HasSubstr("mean of 2 periods"));
    EXPECT_THAT(text_of(here / "spans/frames/000004.png"), HasSubstr("exposed for 40 ms"));
}

TEST_F(MovieProgram, WritesTheFilmAndTheNumbers) {
    const Ended ended = movie({"--frames"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out, "output/fifty\n");
    const fs::path run = here / "output/fifty";
    const FilmedScene read = read_filmed_scene(scene, {}, measurable_in);
    const Plan plan = make_plan(read);

    const auto shots = static_cast<int>(film_schedule(read, plan.clock, plan.steps).size());
    EXPECT_EQ(decoded_pictures(run / "movie.mp4"), shots);
    EXPECT_EQ(std::distance(fs::directory_iterator(run / "frames"), {}), shots);
    EXPECT_TRUE(fs::exists(run / "poster.png"));

    const TrajectoryReader trajectory(run / "trajectory.nc");
    ASSERT_EQ(trajectory.frames(),
              static_cast<std::size_t>(plan.steps / std::llround(plan.trajectory_every) + 1));
    EXPECT_EQ(trajectory.info().species, (std::vector<std::string>{"small", "big"}));
    EXPECT_EQ(trajectory.read(0).size(), 50u);
    EXPECT_EQ(trajectory.read(1).step, plan.trajectory_every);

    EXPECT_EQ(lines_of(run / "measures.csv"), 1 + plan.steps / std::llround(plan.measures_every) + 1);
    const State end = read_grain_table(run / "final.csv");
    EXPECT_EQ(end.size(), 50u);
    const State last = trajectory.read(trajectory.frames() - 1);
    ASSERT_EQ(last.step, plan.steps);
    EXPECT_EQ(end.position, last.position);
    EXPECT_TRUE(fs::exists(run / "checkpoint.grs"));
    EXPECT_THAT(text_of(run / "log.txt"), HasSubstr("segregation"));
}

TEST_F(MovieProgram, TheRecordSaysWhatWasRun) {
    const Ended ended = movie({"--no-film", "--seed", "7", "--threads", "1"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const nlohmann::json record = record_of(here / "output/fifty");
    EXPECT_EQ(record["status"], "complete");
    EXPECT_EQ(record["exit_status"], 0);
    EXPECT_THAT(record["command"], HasSubstr("movie " + scene.string() + " --no-film --seed 7 --threads 1"));
    EXPECT_EQ(record["engine"]["seed"], 7);
    EXPECT_EQ(record["engine"]["grains"], 50);
    EXPECT_EQ(record["engine"]["steps"], make_plan(read_filmed_scene(scene, {}, measurable_in)).steps);
    EXPECT_EQ(record["threads"]["engine"], 1);
    EXPECT_TRUE(record["gl"].is_null());
    EXPECT_EQ(record["engine"]["state_hash"].get<std::string>().size(), 16u);
    EXPECT_FALSE(fs::exists(here / "output/fifty/movie.mp4"));
}

TEST_F(MovieProgram, TheResolvedSceneGivesTheSameRun) {
    ASSERT_EQ(movie({"--no-film"}).status, 0);
    const fs::path resolved = here / "output/fifty/scene.toml";
    const Ended again =
        run_program({"movie", resolved.string(), "--no-film", "--out", "again"}, {here.path(), {}});
    ASSERT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(record_of(here / "again")["engine"]["state_hash"],
              record_of(here / "output/fifty")["engine"]["state_hash"]);
    EXPECT_EQ(text_of(here / "again/final.csv"), text_of(here / "output/fifty/final.csv"));
}

TEST_F(MovieProgram, TheSameBitsOnOneAndOnTwoThreadsWithAndWithoutFilm) {
    ASSERT_EQ(movie({"--no-film", "--threads", "1", "--out", "one"}).status, 0);
    ASSERT_EQ(movie({"--threads", "2", "--out", "two"}).status, 0);
    EXPECT_EQ(record_of(here / "one")["engine"]["state_hash"],
              record_of(here / "two")["engine"]["state_hash"]);
    EXPECT_EQ(text_of(here / "one/measures.csv"), text_of(here / "two/measures.csv"));
    EXPECT_EQ(text_of(here / "one/trajectory.nc"), text_of(here / "two/trajectory.nc"));
}

TEST_F(MovieProgram, OptionsReachTheScene) {
    const Ended ended = movie({"--size", "320x200", "--fps", "20", "--duration", "0.1 s", "--set",
                               "drive.g_level=1.5", "--set", "output.contacts=true"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const FilmedScene resolved = read_filmed_scene(here / "output/fifty/scene.toml", {}, measurable_in);
    EXPECT_EQ(resolved.film.width, 320);
    EXPECT_EQ(resolved.film.height, 200);
    EXPECT_EQ(resolved.film.rate, 20);
    EXPECT_EQ(resolved.run.duration, 0.1);
    EXPECT_NEAR(resolved.drive.g_level(9.81), 1.5, 1e-12);
    EXPECT_TRUE(fs::exists(here / "output/fifty/contacts.nc"));
}

TEST_F(MovieProgram, NeverOverwritesARun) {
    ASSERT_EQ(movie({"--no-film"}).out, "output/fifty\n");
    EXPECT_EQ(movie({"--no-film"}).out, "output/fifty-2\n");
    const std::string before = text_of(here / "output/fifty/run.json");
    const Ended refused = movie({"--no-film", "--out", "output/fifty"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_EQ(refused.err,
              "error: --out output/fifty: exists already; choose another name, or --force to replace it "
              "when the new run is complete\n");
    EXPECT_EQ(text_of(here / "output/fifty/run.json"), before);

    const Ended forced = movie({"--no-film", "--out", "output/fifty", "--force", "--seed", "2"});
    EXPECT_EQ(forced.status, 0) << forced.err;
    EXPECT_EQ(record_of(here / "output/fifty")["engine"]["seed"], 2);
    EXPECT_EQ(std::distance(fs::directory_iterator(here / "output"), {}), 2);  // the old run is gone
}

TEST_F(MovieProgram, ForceKnowsEveryFileThatARunWrites) {
    const std::vector<std::string> words = {"--frames", "--set", "output.contacts=true",
                                            "--out",    "all",   "--force"};
    ASSERT_EQ(movie(words).status, 0);
    const Ended again = movie(words);
    EXPECT_EQ(again.status, 0) << again.err;
    write_text(here / "all/mine.txt", "mine");
    const Ended refused = movie(words);
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.err, HasSubstr("--out all: holds mine.txt"));
    EXPECT_EQ(text_of(here / "all/mine.txt"), "mine");
}

TEST_F(MovieProgram, OutputGoesWhereTheEnvironmentSays) {
    EXPECT_EQ(movie({"--no-film"}, {"GRAINREEL_OUTPUT=elsewhere"}).out, "elsewhere/fifty\n");
    EXPECT_TRUE(fs::exists(here / "elsewhere/fifty/run.json"));
}

TEST_F(MovieProgram, QuietSaysNothingOnStderr) {
    const Ended ended = movie({"--no-film", "--quiet"});
    EXPECT_EQ(ended.status, 0);
    EXPECT_EQ(ended.err, "");
    EXPECT_EQ(ended.out, "output/fifty\n");
}

TEST_F(MovieProgram, ProgressNoneKeepsTheMessages) {
    const Ended ended = movie({"--no-film", "--progress", "none"});
    EXPECT_THAT(ended.err, HasSubstr("wrote output/fifty"));
    EXPECT_THAT(ended.err, Not(HasSubstr("filling")));
}

TEST_F(MovieProgram, ProgressInAPipeIsPlainLines) {
    const Ended ended = movie({});
    EXPECT_THAT(ended.err, HasSubstr("filling"));
    EXPECT_THAT(ended.err, HasSubstr("running   0.00 of 0.20 s"));
    EXPECT_THAT(ended.err, Not(HasSubstr("\r")));
    EXPECT_THAT(ended.err, Not(HasSubstr("\033")));
}

TEST_F(MovieProgram, ProgressJsonIsAnObjectALine) {
    const Ended ended = movie({"--progress", "json"});
    ASSERT_EQ(ended.status, 0);
    std::istringstream lines(ended.err);
    std::vector<std::string> events;
    for (std::string line; std::getline(lines, line);) {
        const nlohmann::json object = nlohmann::json::parse(line);
        events.push_back(object["event"]);
        EXPECT_TRUE(object["event"] != "progress" || (object.contains("stage") && object.contains("done")));
    }
    EXPECT_THAT(events, testing::Contains("progress"));
    EXPECT_THAT(events, testing::Contains("warning"));  // about the film, which strobes
    EXPECT_THAT(events, testing::Contains("info"));
}

// For every mistake the exit status is 2, one line says what is wrong, and nothing is on disk.
TEST_F(MovieProgram, MistakesAreRefusedBeforeAnythingIsWritten) {
    write_text(here / "broken.toml", "title = \n");
    const std::string fifty = scene.string();
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{}, "no command; there are movie, "},
        {{"draw", fifty}, "unknown command 'draw'; there are movie, "},
        {{"movie"}, "movie needs a scene; type"},
        {{"movie", "missing.toml"}, "missing.toml: "},
        {{"movie", "broken.toml"}, "broken.toml:1:"},
        {{"movie", fifty, "--bogus"}, "--bogus"},
        {{"movie", fifty, "--force"}, "--out"},
        {{"movie", fifty, "--progress", "dots"}, "--progress dots: no such form; choose auto, json or none"},
        {{"movie", fifty, "--set", "run.durration=1"}, "durration"},
        {{"movie", fifty, "--duration", "0"}, "larger than 0"},
        {{"movie", fifty, "--duration", "10 kg"}, "10 kg"},
        {{"movie", fifty, "--size", "big"}, "big"},
        {{"movie", fifty, "--threads", "-1"}, "threads"},
        {{"movie", fifty, "--set", "species.small.count=0"}, "count"},
        {{"movie", fifty, "--set", "species.small.count=100000"}, "more than"},
        {{"movie", fifty, "--set", "species.big.diameter=25 mm"}, "diameter"},
        {{"movie", fifty, "--set", "start.method=file", "--set", "start.file=gone.grs"}, "gone.grs"},
        {{"movie", fifty, "--out", ""}, "--out: the name is empty"},
        {{"movie", fifty, "--out", "/dev/null/run"},
         "/dev/null/run: the folder cannot be made: Not a directory"},
    };
    const auto entries = std::distance(fs::directory_iterator(here.path()), {});
    for (const auto& [words, part] : cases) {
        const Ended ended = run_program(words, {here.path(), {}});
        EXPECT_EQ(ended.status, 2) << testing::PrintToString(words) << ended.err;
        EXPECT_THAT(ended.err, HasSubstr(part)) << testing::PrintToString(words);
        EXPECT_THAT(ended.err, testing::StartsWith("error: "));
        EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
        EXPECT_THAT(ended.out, IsEmpty());
        EXPECT_EQ(std::distance(fs::directory_iterator(here.path()), {}), entries)
            << testing::PrintToString(words);
    }
}

TEST_F(MovieProgram, HelpAndVersionGoToStdout) {
    for (const std::vector<std::string>& words : {std::vector<std::string>{"--help"},
                                                  {"movie", "--help"},
                                                  {"render", "--help"},
                                                  {"check", "--help"},
                                                  {"--version"}}) {
        const Ended ended = run_program(words, {here.path(), {}});
        EXPECT_EQ(ended.status, 0);
        EXPECT_THAT(ended.out, Not(IsEmpty()));
        EXPECT_EQ(ended.err, "");
    }
    EXPECT_THAT(run_program({"--version"}, {here.path(), {}}).out, HasSubstr("libavcodec"));
}

TEST_F(MovieProgram, CheckPrintsThePlanAndWritesNothing) {
    const auto entries = std::distance(fs::directory_iterator(here.path()), {});
    const Ended ended = run_program({"check", scene.string()}, {here.path(), {}});
    EXPECT_EQ(ended.status, 0);
    EXPECT_THAT(ended.out,
                HasSubstr(std::to_string(
                    make_plan(read_filmed_scene(scene, {}, measurable_in)).clock.steps_per_period)));
    EXPECT_THAT(ended.out, Not(HasSubstr("phase ")));
    const Ended shifted =
        run_program({"check", scene.string(), "--set", "drive.phase=0.25"}, {here.path(), {}});
    EXPECT_THAT(shifted.out, tells({" m/s", "phase 90 deg", "grows over"}));
    EXPECT_EQ(std::distance(fs::directory_iterator(here.path()), {}), entries);
}

}  // namespace
}  // namespace grainreel
