// Tests of runs that are resumed in their folders: killed runs, stopped runs, and finished runs that are made
// longer. They leave the same files as a run in one go, byte by byte.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>

#include <nlohmann/json.hpp>

#include "engine/base/error.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/measure/columns.hpp"
#include "engine/run/folder/listener.hpp"
#include "render/app/messages/version.hpp"
#include "render/app/verbs/report.hpp"
#include "render/film/run/movie_job.hpp"
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
using testing::HasSubstr;

class ResumedRun : public testing::Test {
  protected:
    using Words = std::vector<std::string>;

    Ended run(const Words& words) const { return run_program(words, {.folder = here.path()}); }
    Words movie(const std::string& out, const Words& more) const {
        Words words = {"movie", "fifty.toml", "--out", out, "--set", "start.settle_limit=0.02 s"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    // Starts the run and kills it when its trajectory has so many frames.
    void kill_at(std::size_t frames, const Words& more, int signal = SIGKILL) const {
        Program program(movie("run", more), {.folder = here.path()});
        ASSERT_TRUE(wait_until(program, [&] { return frames_in("run") >= frames; }));
        program.send(signal);
        EXPECT_EQ(program.wait().status, 128 + signal);
    }
    std::size_t frames_in(const std::string& folder) const {
        try {
            return TrajectoryReader(here / folder / "trajectory.nc").frames();
        } catch (const UserError&) {
            return 0;  // the file is not there yet
        }
    }
    nlohmann::json record(const std::string& folder) const {
        return nlohmann::json::parse(text_of(here / folder / "run.json"));
    }
    static std::set<std::string> pictures_in(const fs::path& folder) {
        std::set<std::string> names;
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(folder / "frames", none))
            names.insert(entry.path().filename());
        return names;
    }
    // Compares all files of both runs, except for what depends on wall time.
    void expect_same(const std::string& whole, const std::string& resumed) const {
        EXPECT_EQ(record(resumed)["status"], "complete");
        EXPECT_EQ(record(resumed)["engine"]["state_hash"], record(whole)["engine"]["state_hash"]);
        for (const char* file : {"trajectory.nc", "measures.csv", "contacts.nc", "fields.nc", "outflow.csv",
                                 "film_moments.nc", "key_moments.nc", "key_contacts.nc", "final.csv"}) {
            ASSERT_EQ(fs::exists(here / resumed / file), fs::exists(here / whole / file)) << file;
            EXPECT_EQ(text_of(here / resumed / file) == text_of(here / whole / file), true) << file;
        }
        EXPECT_EQ(record(resumed)["written"]["film_frames"], record(whole)["written"]["film_frames"]);
        EXPECT_EQ(pictures_in(here / resumed), pictures_in(here / whole));
        for (const std::string& name : pictures_in(here / whole))
            EXPECT_EQ(text_of(here / resumed / "frames" / name) == text_of(here / whole / "frames" / name),
                      true)
                << name;
        if (!fs::exists(here / whole / "movie.mp4")) return;
        EXPECT_EQ(decoded_pictures(here / resumed / "movie.mp4"),
                  decoded_pictures(here / whole / "movie.mp4"));
    }

    TemporaryFolder here;
    fs::path scene = write_small_scene(here.path());
};

const std::vector<std::string> with_all = {"--duration", "1.5 s",
                                           "--set",      "output.contacts=true",
                                           "--set",      "output.instruments=[\"walls\", \"bed\"]",
                                           "--set",      "output.fields.grid=yz",
                                           "--set",      "output.fields.periods=3",
                                           "--set",      "film.segment=[{playback=5}]",
                                           "--frames"};

// Only faces of a container have a profile of pressure, so such a run has no fields.nc.
TEST_F(ResumedRun, WithForcesOnMeshesAlone) {
    std::ofstream(here / "ball.toml") << R"([[species]]
name = "ball"
diameter = "4 mm"
density = 2500
[container]
shape = "none"
[[mesh]]
name = "plate"
file = "shipped:gate.stl"
[[grain]]
species = "ball"
position = [0, 0, "3 mm"]
[run]
duration = "2 ms"
[output]
instruments = ["walls"]
)";
    ASSERT_EQ(run({"movie", "ball.toml", "--no-film", "--no-report", "--out", "run"}).status, 0);
    EXPECT_FALSE(fs::exists(here / "run" / "fields.nc"));
    const Ended ended = run({"resume", "run", "--until", "4 ms", "--no-film", "--no-report"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(record("run")["status"], "complete");
}

TEST_F(ResumedRun, DamagedKeyMomentsAreSaid) {
    ASSERT_EQ(run(movie("run", {})).status, 0);
    fs::resize_file(here / "run" / "key_moments.nc", fs::file_size(here / "run" / "key_moments.nc") / 2);
    const Ended ended = run({"resume", "run", "--for", "0.1 s"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("key_moments.nc: was cut off"));
    EXPECT_THAT(ended.err, tells({"lack forces", "moments before"}));
}

TEST_F(ResumedRun, AKilledOneEndsAsIfItHadNotBeen) {
    ASSERT_EQ(run(movie("whole", with_all)).status, 0);
    kill_at(9, with_all);
    const Ended ended = run({"resume", "run"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out, "run\n");
    EXPECT_THAT(ended.err, HasSubstr("to 1.5 s"));
    expect_same("whole", "run");
}

// A kill in the middle of a write leaves a frame that is counted but not whole.
TEST_F(ResumedRun, AFrameThatWasHalfWrittenIsWrittenAgain) {
    ASSERT_EQ(run(movie("whole", with_all)).status, 0);
    kill_at(9, with_all);
    for (const char* file :
         {"trajectory.nc", "film_moments.nc", "contacts.nc", "fields.nc", "key_moments.nc"})
        fs::resize_file(here / "run" / file, fs::file_size(here / "run" / file) - 10);
    const Ended ended = run({"resume", "run"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    expect_same("whole", "run");
}

// Browsers do not play Matroska, so the page needs a copy, which is written together with the film.
TEST_F(ResumedRun, TheCopyForThePageIsWhole) {
    const Words words = {"--duration", "1.5 s", "--format", "ffv1"};
    kill_at(9, words);
    EXPECT_FALSE(fs::exists(here / "run/movie_720.mp4"));
    const Ended ended = run({"resume", "run"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_GT(decoded_pictures(here / "run/movie_720.mp4"), 10);
    EXPECT_EQ(decoded_pictures(here / "run/movie_720.mp4"), decoded_pictures(here / "run/movie.mkv"));
    EXPECT_FALSE(fs::exists(here / "run/movie_720.mp4.part"));
    EXPECT_THAT(text_of(here / "run/report.html"), HasSubstr("copy of at most 720 lines"));
}

TEST_F(ResumedRun, KilledTwiceAndStoppedOnce) {
    const Words without_film = {"--duration", "1.5 s", "--no-film"};
    ASSERT_EQ(run(movie("whole", without_film)).status, 0);
    kill_at(3, without_film);
    for (const std::size_t frames : {10, 18}) {
        Program program({"resume", "run"}, {.folder = here.path()});
        ASSERT_TRUE(wait_until(program, [&] { return frames_in("run") >= frames; }));
        program.send(frames == 10 ? SIGINT : SIGKILL);
        EXPECT_EQ(program.wait().status, frames == 10 ? 130 : 137);
    }
    ASSERT_EQ(run({"resume", "run", "--threads", "2"}).status, 0);
    expect_same("whole", "run");
}

TEST_F(ResumedRun, AFinishedOneIsMadeLonger) {
    Words more = with_all;
    more.push_back("--no-report");  // without key moments, because these are chosen for a run's end
    more[1] = "0.4 s";
    ASSERT_EQ(run(movie("whole", more)).status, 0);
    more[1] = "0.25 s";
    ASSERT_EQ(run(movie("run", more)).status, 0);
    const Ended over = run({"resume", "run"});
    EXPECT_EQ(over.status, 2);
    EXPECT_THAT(over.err, tells({"run: ", "0.25 s already", "later end"}));
    ASSERT_EQ(run({"resume", "run", "--for", "0.15s"}).status, 0);
    expect_same("whole", "run");
}

// The plan chose the stiffness of contacts with glued grains beside that of the pair of species.
TEST_F(ResumedRun, GluedGrainsStayAsStiff) {
    for (const char* law : {"contact.law=walton-braun", "contact.law=hertz"}) {
        SCOPED_TRACE(law);
        for (const char* folder : {"whole", "run", "anew"}) fs::remove_all(here / folder);
        Words more = {
            "--duration", "0.2 s", "--no-film", "--no-report", "--threads",
            "1",          "--set", law,         "--set",       "container.wall_grains={faces=[\"floor\"]}"};
        ASSERT_EQ(run(movie("whole", more)).status, 0);
        more[1] = "0.1 s";
        ASSERT_EQ(run(movie("run", more)).status, 0);
        ASSERT_EQ(run({"resume", "run", "--for", "0.1 s"}).status, 0);
        expect_same("whole", "run");
        const Ended anew = run({"movie", "whole/scene.toml", "--no-film", "--no-report", "--out", "anew"});
        ASSERT_EQ(anew.status, 0) << anew.err;
        expect_same("whole", "anew");
    }
}

// Where restitution depends on speed, the plan's stiffness is that of the expected impact, and sums of wall
// forces count in units of it. A run that goes on rains no more, but it expects what it expected when it
// began.
TEST_F(ResumedRun, RestitutionByImpactSpeedCountsWallForcesOn) {
    const std::string top = SmallScene().beads(40).contacts("0.7", "0.3").text(),
                      bed = SmallScene().box("30 mm", "20 mm", "100 mm").shaken("60 Hz", "1.5").text();
    const std::string rest =
        "[start]\nmethod = \"rain\"\nrain_rate = 2000\nsettle_limit = 0.02\n[run]\naccuracy = \"draft\"\n"
        "[output]\ninstruments = [\"walls\"]\nmeasures_interval = \"5 ms\"\n";
    for (const char* by_speed :
         {"restitution_speed = 0.5\n",
          "wall.restitution_table = [[\"1 mm/s\", 0.9], [\"0.1 m/s\", 0.8], [\"2 m/s\", 0.5]]\n"}) {
        SCOPED_TRACE(by_speed);
        for (const char* folder : {"whole", "run"}) fs::remove_all(here / folder);
        write_text(here / "rain.toml", top + "law = \"walton-braun\"\n" + by_speed + bed + rest);
        Words words = {"movie", "rain.toml", "--no-film", "--no-report", "--threads",
                       "1",     "--out",     "whole",     "--duration",  "0.1 s"};
        ASSERT_EQ(run(words).status, 0);
        words[7] = "run", words[9] = "0.05 s";
        ASSERT_EQ(run(words).status, 0);
        const Ended ended = run({"resume", "run", "--for", "0.05 s", "--no-report"});
        ASSERT_EQ(ended.status, 0) << ended.err;
        expect_same("whole", "run");
        EXPECT_THAT(ended.err, testing::Not(HasSubstr("warning:"))) << "its contacts are those of the start";
    }
}

TEST_F(ResumedRun, GrainsThatLeaveAreToldOnce) {
    const Words more = {"--duration", "1 s", "--no-film", "--set",
                        "container.outlet={width=\"9 mm\", exit_depth=\"6 mm\"}"};
    ASSERT_EQ(run(movie("whole", more)).status, 0);
    kill_at(6, more);
    ASSERT_EQ(run({"resume", "run"}).status, 0);
    expect_same("whole", "run");
}

// A picture of means and forces needs more than a moment, so the run begins anew from its packing.
TEST_F(ResumedRun, AFilmOfMeansAndForcesIsMadeAnew) {
    const Words more = {"--duration", "1.5 s",
                        "--set",      "film.segment=[{playback=2, exposure=\"5 ms\"}]",
                        "--set",      "film.force_chains=true",
                        "--frames"};
    ASSERT_EQ(run(movie("whole", more)).status, 0);
    kill_at(5, more, SIGINT);
    const Ended ended = run({"resume", "run"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("goes on from 0 s"));
    expect_same("whole", "run");
}

// A picture on the way between two locked moments needs the one before it, which is among the film's moments.
TEST_F(ResumedRun, AFilmWithPicturesBetweenLockedMomentsGoesOn) {
    const Words more = {"--duration", "1.5 s", "--set", "film.segment=[{kind=\"locked\", between=2}]",
                        "--frames"};
    ASSERT_EQ(run(movie("whole", more)).status, 0);
    kill_at(9, more, SIGINT);  // an interrupted run leaves a checkpoint, a killed one perhaps only the first
    const Ended ended = run({"resume", "run"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, testing::Not(HasSubstr("goes on from 0 s")));
    expect_same("whole", "run");
}

// A slow motion at the end moves to the new end.
TEST_F(ResumedRun, TheFilmsLastSegmentMovesToTheNewEnd) {
    const auto with_end = [](const char* duration) {
        return Words{"--duration", duration,
                     "--frames",   "--no-report",
                     "--set",      "film.segment=[{playback=2}, {playback=0.5, duration=\"0.05 s\"}]"};
    };
    ASSERT_EQ(run(movie("whole", with_end("0.4 s"))).status, 0);
    ASSERT_EQ(run(movie("run", with_end("0.2 s"))).status, 0);
    ASSERT_EQ(run({"resume", "run", "--until", "0.4 s"}).status, 0);
    expect_same("whole", "run");
}

// The container changes to the new drive without a jump, and each part of the run is restored as it was.
TEST_F(ResumedRun, AnAcceptedDriveTakesOverSmoothly) {
    ASSERT_EQ(run(movie("run", {"--duration", "0.2 s", "--size", "320x240"})).status, 0);
    const auto grain_at = [&](const char* time) {
        const Ended ended = run({"inspect", "run", "--at", time, "--grain", "7", "--json"});
        EXPECT_EQ(ended.status, 0) << ended.err;
        return ended.out;
    };
    const std::string before = grain_at("0.133 s");
    const Ended ended = run({"resume", "run", "--for", "0.4 s", "--accept", "drive.g_level=1.5"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("'drive.amplitude' is "));
    const std::string text = text_of(here / "run/scene.toml");
    EXPECT_THAT(text, HasSubstr("[[drive.stage]]\nfrom = 0.2"));
    EXPECT_THAT(text, HasSubstr("From here on: Γ 1.5 instead of 2"));
    EXPECT_EQ(grain_at("0.133 s"), before);
    const auto table = read_measures(here / "run/measures.csv");
    const auto column = [&](const char* name) {
        const auto& names = table->columns();
        const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
        return table->values(at, 0, table->rows());
    };
    const std::vector<double> time = column("time_s"), floor = column("floor_position_m"),
                              level = column("drive_g_level");
    const double fastest = 2 * 9.81 / (2 * std::numbers::pi * 20);  // m/s, a 2 pi f at the first drive
    for (std::size_t k = 1; k < time.size(); ++k)
        EXPECT_LE(std::abs(floor[k] - floor[k - 1]), 1.01 * fastest * (time[k] - time[k - 1])) << time[k];
    EXPECT_NEAR(*std::max_element(level.begin(), level.end()), 2,
                1e-6);  // the drive grows from 0 at the beginning
    EXPECT_NEAR(level.back(), 1.5, 1e-6);
    // Compares a kept moment of the second part with the same moment restored.
    const auto place = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"inspect", "run", "--at", "0.45 s", "--grain", "7", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        return nlohmann::json::parse(run(words).out)["tables"]["grain"]["rows"][0];
    };
    const auto kept = place({"--no-replay"}), back = place({});
    for (int k = 0; k < 5; ++k) EXPECT_EQ(kept[k], back[k]) << k;
}

TEST_F(ResumedRun, ARunThatGoesOnKeepsItsCheckpoints) {
    Program program(movie("run", {"--duration", "600 s", "--no-film"}), {.folder = here.path()});
    ASSERT_TRUE(wait_until(program, [&] { return frames_in("run") >= 5; }));
    program.send(SIGSTOP);
    const std::string checkpoint = text_of(here / "run/checkpoint.grs");
    const Ended ended = run({"resume", "run", "--accept", "drive.g_level=1.5"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.err, tells({"run: ", "in use", "process"}));
    EXPECT_EQ(text_of(here / "run/checkpoint.grs") == checkpoint, true);
    program.send(SIGCONT);
    program.send(SIGKILL);
    program.wait();
}

// Each pair in the run's scene has its own friction, and all of them change.
TEST_F(ResumedRun, AnAcceptedFrictionIsThatOfAllPairs) {
    ASSERT_EQ(run(movie("run", {"--duration", "0.1 s", "--no-film"})).status, 0);
    fs::copy(here / "run", here / "as_before", fs::copy_options::recursive);
    ASSERT_EQ(run({"resume", "run", "--for", "0.1 s", "--accept", "contact.friction=0.2"}).status, 0);
    ASSERT_EQ(run({"resume", "as_before", "--for", "0.1 s"}).status, 0);
    const std::string text = text_of(here / "run/scene.toml");
    EXPECT_EQ(text.find("\nfriction = 0.4"), text.npos);
    EXPECT_NE(text.find("\nfriction = 0.2"), text.npos);
    EXPECT_NE(record("run")["engine"]["state_hash"], record("as_before")["engine"]["state_hash"]);
    const Ended same = run({"resume", "run", "--for", "0.1 s", "--accept", "contact.friction=0.2"});
    EXPECT_EQ(same.status, 2);
    EXPECT_THAT(same.err, tells({"--accept", "'contact.friction'", "what it was"}));
}

TEST_F(ResumedRun, WithoutOneOfItsFilesItIsRefusedAndLeftAsItIs) {
    ASSERT_EQ(
        run(movie("whole", {"--duration", "0.2 s", "--no-film", "--set", "output.contacts=true"})).status, 0);
    for (const char* file : {"trajectory.nc", "measures.csv", "contacts.nc"})
        for (const bool emptied : {false, true}) {
            fs::remove_all(here / "run");
            fs::copy(here / "whole", here / "run", fs::copy_options::recursive);
            emptied ? fs::resize_file(here / "run" / file, 0) : (void)fs::remove(here / "run" / file);
            const Ended ended = run({"resume", "run", "--for", "0.1 s"});
            EXPECT_EQ(ended.status, 2) << file << ' ' << ended.err;
            EXPECT_THAT(ended.err, HasSubstr(file));
            for (const char* other : {"trajectory.nc", "measures.csv", "contacts.nc", "final.csv",
                                      "checkpoint.grs", "run.json", "scene.toml"}) {
                if (std::string(other) == file) continue;
                EXPECT_EQ(text_of(here / "run" / other) == text_of(here / "whole" / other), true) << other;
            }
        }
}

// The user asks the run to stop when its grains are packed and its drive has not begun.
class StoppedAtOnce final : public SilentListener {
  public:
    int stop_signal() const override { return SIGINT; }
};

TEST_F(ResumedRun, OneThatWasStoppedJustAfterPackingGoesOn) {
    ASSERT_EQ(run(movie("packed", {"--duration", "0.05 s", "--no-film"})).status, 0);
    // A start from a checkpoint is over before the run looks at the signal, as the end of a packing is.
    const Words sets = {"start.method=file", "start.file=" + (here / "packed/checkpoint.grs").string()};
    Words words = {"movie", "fifty.toml", "--out", "whole"};
    for (const std::string& set : sets) words.insert(words.end(), {"--set", set});
    ASSERT_EQ(run(words).status, 0);
    const FilmedScene made = read_filmed_scene(scene, Assignments(sets.begin(), sets.end()), measurable_in);
    FilmRequest request;
    request.out = here / "run";
    request.page = page_of_ended_run();
    request.program = program_info();  // files name it
    StoppedAtOnce listener;
    {
        MovieJob stopped(request, listener, made, plan_with_film(made));
        EXPECT_EQ(stopped.run().exit_status, 130);
    }
    EXPECT_EQ(record("run")["status"], "interrupted");
    EXPECT_EQ(record("run")["engine"]["steps"], 0);
    ASSERT_TRUE(fs::exists(here / "run/checkpoint.grs"));
    const Ended ended = run({"resume", "run"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("from 0 s to 0.2 s"));
    expect_same("whole", "run");
}

// If the last checkpoint is lost, the rows tell how far the run came.
TEST_F(ResumedRun, ALostCheckpointDoesNotMakeItShorter) {
    ASSERT_EQ(run(movie("run", {"--duration", "0.2 s", "--no-film"})).status, 0);
    fs::remove(here / "run/checkpoint.grs");
    ASSERT_EQ(run({"resume", "run", "--for", "0.1 s"}).status, 0);
    EXPECT_NEAR(record("run")["engine"]["simulated_s"].get<double>(), 0.3, 1e-3);
}

TEST_F(ResumedRun, WhatWouldOverlapOrChangeTheGrainsIsNotAccepted) {
    ASSERT_EQ(run(movie("run", {"--duration", "0.1 s", "--no-film"})).status, 0);
    const std::string text = text_of(here / "run/scene.toml");
    const auto refused = [&](const std::string& accept, const char* says) {
        const Ended ended = run({"resume", "run", "--for", "0.1 s", "--accept", accept});
        EXPECT_EQ(ended.status, 2) << ended.err;
        EXPECT_THAT(ended.err, HasSubstr(says));
        EXPECT_EQ(text_of(here / "run/scene.toml"), text);
    };
    refused("drive.g_level=8", "--accept: grains would overlap by");
    refused("gravity=[0.0, 0.0, -1.6]", "'gravity' cannot change while a run goes on");
    refused("drive.frequency=10 Hz", "cannot change while a run goes on");
    refused("contact.restitution=0.5", "--accept: 'contact.restitution' cannot change while a run goes on");
    refused("contact.restitution", "--accept: 'contact.restitution' cannot change while a run goes on");
    refused("contact.friction=0.4", "--accept: 'contact.friction' is what it was in this run");
    ASSERT_EQ(run({"resume", "run", "--for", "0.1 s"}).status, 0);
}

TEST_F(ResumedRun, MistakesAreOneLineAndChangeNothing) {
    ASSERT_EQ(run(movie("run", {"--duration", "0.1 s", "--no-film"})).status, 0);
    const auto refused = [&](const Words& words, const char* says) {
        const std::string before = text_of(here / "run/measures.csv") + text_of(here / "run/run.json");
        const Ended ended = run(words);
        EXPECT_EQ(ended.status, 2) << ended.err;
        EXPECT_THAT(ended.err, HasSubstr(says));
        EXPECT_EQ(text_of(here / "run/measures.csv") + text_of(here / "run/run.json"), before);
    };
    refused({"resume", "nowhere"}, "nowhere: no such folder");
    refused({"resume", "."}, "has no scene.toml");
    refused({"resume", "run", "--until", "0.05 s"}, "--until: the run has come to 0.1 s already");
    refused({"resume", "run", "--until", "1 s", "--for", "1 s"}, "--for");
    refused({"resume", "run", "--for", "3 kg"}, "--for must be a time");
    const std::string text = text_of(here / "run/scene.toml");
    const auto with = [&](const std::string& key, const std::string& value) {
        std::string changed = text;
        const std::size_t at = changed.find(key + " = ");
        changed.replace(at, changed.find('\n', at) - at, key + " = " + value);
        write_text(here / "run/scene.toml", changed);
    };
    with("gravity", "[0.0, 0.0, -9.7]");
    refused({"resume", "run", "--for", "1 s"}, "'gravity' is [0.0, 0.0, -9.7], but it was [0.0, 0.0, -9.81]");
    with("measures_interval", "0.001");
    refused({"resume", "run", "--for", "1 s"}, "'output.measures_interval' is 0.001, but it was");
    write_text(here / "run/scene.toml", text);
    fs::remove_all(here / "run/checkpoints");
    fs::remove(here / "run/checkpoint.grs");
    refused({"resume", "run", "--for", "1 s"}, "has no checkpoint");
}

}  // namespace
}  // namespace grainreel
