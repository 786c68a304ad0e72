// Tests of `grainreel compare` as a user sees it: several scenes in one film.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>

#include "engine/files/trajectory/trajectory.hpp"
#include "engine/grain_table.hpp"
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
using testing::Not;

nlohmann::json record_of(const fs::path& run) {
    return nlohmann::json::parse(text_of(run / "run.json"));
}

class CompareProgram : public testing::Test {
  protected:
    CompareProgram() {
        write("weak.toml", "g_level = 1.2");
        write("strong.toml", "g_level = 3");
    }
    void write(const std::string& name, const std::string& level, const std::string& duration = "0.2 s") {
        std::string text = small_scene_text;
        text.replace(text.find("g_level = 2"), 11, level);
        text.replace(text.find("0.2 s"), 5, duration);
        text.replace(text.find("160x120"), 7, "480x270");
        write_text(here / name, text);
    }
    Ended program(const std::vector<std::string>& words) { return run_program(words, {here.path(), {}}); }

    TemporaryFolder here;
};

// The film shows 0.2 s at half speed and 30 frames a second: one frame every 1/60 s, both ends included.
constexpr int frames_of_film = 13;

TEST_F(CompareProgram, FilmsScenesInStepAndKeepsTheirRuns) {
    const Ended ended = program({"compare", "weak.toml", "strong.toml", "--frames"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out, "output/weak-vs-strong\n");
    const fs::path all = here / "output/weak-vs-strong";
    EXPECT_EQ(decoded_pictures(all / "movie.mp4"), frames_of_film);
    // IHDR has width and height, big-endian.
    EXPECT_EQ(text_of(all / "frames/000000.png").substr(16, 8), std::string("\0\0\x1\xe0\0\0\x1\x0e", 8));
    const nlohmann::json record = record_of(all);
    EXPECT_EQ(record["status"], "complete");
    EXPECT_THAT(record["panels"], testing::ElementsAre("weak", "strong"));
    EXPECT_EQ(record["written"]["film_frames"], frames_of_film);
    for (const std::string name : {"weak", "strong"}) {
        // The same scene alone gives the same results, to the bit.
        ASSERT_EQ(program({"movie", name + ".toml", "--no-film", "--out", name}).status, 0);
        EXPECT_EQ(record_of(all / name)["engine"]["state_hash"],
                  record_of(here / name)["engine"]["state_hash"]);
        EXPECT_EQ(record_of(all / name)["status"], "complete");
        EXPECT_EQ(text_of(all / name / "final.csv"), text_of(here / name / "final.csv"));
        EXPECT_EQ(text_of(all / name / "measures.csv"), text_of(here / name / "measures.csv"));
        EXPECT_TRUE(text_of(all / name / "trajectory.nc") == text_of(here / name / "trajectory.nc"));
    }
}

// The film's segments are those of one scene. The other scenes may have fewer, and all show the same stretch
// of time.
TEST_F(CompareProgram, SegmentsOfOneSceneHoldForAll) {
    std::string text = text_of(here / "weak.toml");
    text.replace(text.find("[[film.segment]]"), std::string::npos,
                 "[[film.segment]]\nkind = \"locked\"\nduration = 0.1\naverage = 1\n"
                 "[[film.segment]]\nplayback = 0.5\nexposure = \"10 ms\"\n");
    write_text(here / "weak.toml", text);
    const Ended ended = program({"compare", "weak.toml", "strong.toml", "--out", "all"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(decoded_pictures(here / "all/movie.mp4"), 2 + 7);  // periods of 0.05 s, then every 1/60 s
}

TEST_F(CompareProgram, TakesFinishedRunsToo) {
    for (const std::string name : {"weak", "strong"})
        ASSERT_EQ(program({"movie", name + ".toml", "--no-film", "--out", name}).status, 0);
    const Ended runs = program({"compare", "weak", "strong", "--out", "runs"});
    EXPECT_EQ(runs.status, 0) << runs.err;
    EXPECT_EQ(decoded_pictures(here / "runs/movie.mp4"), frames_of_film);
    const Ended kept = program({"compare", "weak", "strong", "--out", "kept", "--no-replay"});
    EXPECT_EQ(kept.status, 0) << kept.err;
    EXPECT_EQ(decoded_pictures(here / "kept/movie.mp4"), 5);  // 0.2 s at 20 Hz, one a period
    EXPECT_THAT(kept.err, tells({"--no-replay", "nothing", "brought back", "film shows"}));
    const nlohmann::json record = record_of(here / "runs");
    EXPECT_EQ(record["drawn"].size(), 2u);
    EXPECT_TRUE(record["engine"].is_null());
    // A comparison of a finished run and a scene gives the same film.
    ASSERT_EQ(program({"compare", "weak", "strong.toml", "--out", "mixed", "--frames", "--set",
                       "film.camera.frame=container"})
                  .status,
              0);
    ASSERT_EQ(program({"compare", "weak", "strong", "--out", "again", "--frames", "--set",
                       "film.camera.frame=container"})
                  .status,
              0);
    EXPECT_TRUE(fs::exists(here / "mixed/strong/trajectory.nc"));
    for (const char* frame : {"frames/000000.png", "frames/000004.png"}) {
        const auto pixels = [&](const char* folder) {
            const std::string text = text_of(here / folder / frame);
            return text.substr(text.find("IDAT"));
        };
        EXPECT_TRUE(pixels("mixed") == pixels("again")) << frame;
    }
}

// A film of finished runs has all that a film can show during a run: plots, live words, displacements over a
// period, forces, trails.
TEST_F(CompareProgram, FinishedRunsLackNothing) {
    for (const std::string name : {"weak", "strong"}) {
        std::string text = text_of(here / (name + ".toml"));
        text.replace(text.find("[film]"), 6,
                     "[output]\ncontacts = true\n[film]\ntext = \"mixing {lacey}\"\nforce_chains = true\n");
        text.replace(
            text.find("[[film.segment]]"), std::string::npos,
            "[film.colour]\nby = \"displacement\"\n[film.trails]\nspecies = [\"big\"]\nduration = 0.1\n"
            "[film.arrows]\ngrid = 4\n[[film.plot]]\ny = \"kinetic\"\n"
            "[[film.segment]]\nkind = \"locked\"\n");
        write_text(here / (name + ".toml"), text);
        ASSERT_EQ(program({"movie", name + ".toml", "--no-film", "--out", name}).status, 0);
    }
    const std::vector<std::string> options = {
        "--frames", "--no-film", "--set", "film.size=720x540", "--set", "film.camera.frame=container"};
    const auto compare = [&](const std::string& first, const std::string& second, const std::string& out) {
        std::vector<std::string> words = {"compare", first, second, "--out", out};
        words.insert(words.end(), options.begin(), options.end());
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 0) << ended.err;
        return ended.err;
    };
    compare("weak.toml", "strong.toml", "live");
    EXPECT_THAT(compare("weak", "strong", "finished"), Not(HasSubstr("warning")));
    // (The last two frames are left out, because the trajectory has their arrows only in single precision: a
    // pixel may differ by one step of 255.)
    for (const char* frame : {"frames/000000.png", "frames/000001.png", "frames/000002.png"}) {
        const auto pixels = [&](const char* folder) {
            const std::string text = text_of(here / folder / frame);
            return text.substr(text.find("IDAT"));
        };
        EXPECT_TRUE(pixels("live") == pixels("finished")) << frame;
    }
}

TEST_F(CompareProgram, WhatHasNoRoomOrCannotBeShownIsNamed) {
    ASSERT_EQ(program({"movie", "weak.toml", "--no-film", "--out", "run", "--set",
                       "film.plot=[{y=\"lacey\"}]", "--set", "film.segment=[{average=1,kind=\"locked\"}]"})
                  .status,
              0);
    const Ended ended = program({"compare", "run", "run", "--size", "320x240", "--set", "film.axes=true",
                                 "--set", "film.words=none", "--no-replay"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, tells({"--size", "320x240", "no room", "plots", "2 panels", "left out"}));
    EXPECT_THAT(ended.err, tells({"film.axes", "side by side", "no axes"}));
    EXPECT_THAT(ended.err, tells({"film.words", "side by side", "beside the panels"}));
    EXPECT_THAT(ended.err, tells({"'average'", "left out", "single moments"}));
}

// A run that kept no frame a period before the others cannot show displacements over a period.
TEST_F(CompareProgram, DisplacementsThatCannotBeKnownAreNamed) {
    const std::vector<std::string> movie = {"movie", "weak.toml", "--no-film", "--out", "run"};
    std::vector<std::string> sparse = movie;
    sparse.insert(sparse.end(), {"--set", "output.trajectory_interval=80 ms"});
    ASSERT_EQ(program(sparse).status, 0);
    const std::vector<std::string> compare = {"compare", "run", "run", "--set",
                                              "film.colour.by=displacement"};
    const Ended whole = program(compare);
    EXPECT_EQ(whole.status, 0) << whole.err;
    EXPECT_THAT(whole.err, Not(HasSubstr("a period before them")));
    std::vector<std::string> kept = compare;
    kept.insert(kept.end(), {"--no-replay", "--out", "kept"});
    const Ended ended = program(kept);
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, tells({"run/trajectory.nc", "2 of its 3", "none", "period before"}));
}

// Two drives are in a locked film: each panel has its own words about time.
TEST_F(CompareProgram, UnlikeDrivesHaveACaptionEach) {
    for (const auto& [name, frequency] : {std::pair{"weak", "20 Hz"}, {"strong", "25 Hz"}}) {
        std::string text = text_of(here / (std::string(name) + ".toml"));
        text.replace(text.find("20 Hz"), 5, frequency);
        text.replace(text.find("playback = 0.5"), 14, "kind = \"locked\"");
        write_text(here / (std::string(name) + ".toml"), text);
    }
    ASSERT_EQ(
        program({"compare", "weak.toml", "strong.toml", "--frames", "--no-film", "--out", "both"}).status, 0);
    const std::string png = text_of(here / "both/frames/000001.png");
    EXPECT_THAT(png, tells({"1 frame a period", "phase 0", "1.5×", " | on average", "every 1.25 periods",
                            "phase 0", "1.5×"}));
}

// The film is the same as that of files with these values, except for the panels' names.
TEST_F(CompareProgram, VariesAKeyOfOneScene) {
    const Ended ended = program({"compare", "weak.toml", "--vary", "drive.g_level=1.2,3", "--seed", "4",
                                 "--frames", "--no-film", "--out", "varied"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(record_of(here / "varied")["panels"],
                testing::ElementsAre("weak-g_level-1.2", "weak-g_level-3"));
    ASSERT_EQ(program({"compare", "weak.toml", "strong.toml", "--seed", "4", "--frames", "--no-film", "--out",
                       "files"})
                  .status,
              0);
    const auto pixels = [&](const char* frame) {
        const std::string text = text_of(here / frame);
        return text.substr(text.find("IDAT"));
    };
    EXPECT_TRUE(pixels("varied/frames/000007.png") == pixels("files/frames/000007.png"));
    EXPECT_EQ(record_of(here / "varied/weak-g_level-3")["engine"]["state_hash"],
              record_of(here / "files/strong")["engine"]["state_hash"]);
    const Ended again = program({"compare", "varied/weak-g_level-1.2", "varied/weak-g_level-3", "--frames",
                                 "--no-film", "--out", "again"});
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(std::distance(fs::directory_iterator(here / "again/frames"), {}), frames_of_film);
}

TEST_F(CompareProgram, VariesWhatIsDrawnOfARunToo) {
    ASSERT_EQ(program({"movie", "weak.toml", "--no-film", "--out", "run"}).status, 0);
    const Ended ended = program(
        {"compare", "run", "--vary", "film.colour.by=speed,start-height", "--at", "0.07", "--out", "two"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_TRUE(fs::exists(here / "two/still-0.070s.png"));
    const Ended drive = program({"compare", "run", "--vary", "drive.g_level=1,2", "--out", "no"});
    EXPECT_EQ(drive.status, 2);
    EXPECT_THAT(drive.err, tells({"--vary drive.g_level", "run is over"}));
}

// One moment of all panels is drawn: of scenes, which are run for it, and of their finished runs.
TEST_F(CompareProgram, AtDrawsOneMoment) {
    const std::vector<std::string> still = {"--at", "0.0333333333", "--set", "film.camera.frame=container"};
    const auto drawn = [&](std::vector<std::string> words, const std::string& out) {
        words.insert(words.end(), still.begin(), still.end());
        words.insert(words.end(), {"--out", out});
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 0) << ended.err;
        const std::string png = text_of(here / out / "still-0.033333s.png");
        return png.substr(png.find("IDAT"));
    };
    const std::string live = drawn({"compare", "weak.toml", "strong.toml"}, "live");
    EXPECT_FALSE(fs::exists(here / "live/movie.mp4"));
    EXPECT_TRUE(live == drawn({"compare", "live/weak", "live/strong"}, "finished"));
    const Ended far = program({"compare", "live/weak", "live/strong", "--at", "0.5", "--out", "far"});
    EXPECT_EQ(far.status, 2);
    EXPECT_THAT(far.err, tells({"--at", "0.5 s", "outside the time"}));
    EXPECT_FALSE(fs::exists(here / "far"));
}

// A still counts heights at the start as the film does, from the film's first picture.
TEST_F(CompareProgram, AStillHasTheStartHeightsOfTheFilm) {
    const std::string by_height = "film.colour={by=\"start-height\"}";
    ASSERT_EQ(
        program({"compare", "weak.toml", "strong.toml", "--frames", "--set", by_height, "--out", "film"})
            .status,
        0);
    const Ended still = program({"compare", "film/weak", "film/strong", "--at", "0.1", "--out", "still"});
    ASSERT_EQ(still.status, 0) << still.err;
    const Ended other = program({"compare", "film/weak", "film/strong", "--at", "0", "--out", "first"});
    ASSERT_EQ(other.status, 0) << other.err;
    const auto record = record_of(here / "still")["drawn"][0];
    EXPECT_EQ(record["first_s"], 0.0);
    EXPECT_NEAR(record["last_s"].get<double>(), 0.1, 1e-3);
    EXPECT_EQ(record_of(here / "first")["drawn"][0]["last_s"], 0.0);
}

// A still has the trails that the film has at this moment.
TEST_F(CompareProgram, AStillHasTheTrailsOfTheFilm) {
    const std::vector<std::string> bare = {"--set", "film.show=[\"time\"]", "--set",
                                           "film.camera.frame=container"};
    const std::string trails = "film.trails={species=[\"big\"], duration=\"50 ms\"}";
    const auto drawn = [&](std::vector<std::string> words, bool with_trails) {
        words.insert(words.end(), bare.begin(), bare.end());
        if (with_trails) words.insert(words.end(), {"--set", trails});
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 0) << ended.err;
    };
    const auto pixels = [&](const std::string& file) {
        const std::string png = text_of(here / file);
        return png.substr(png.find("IDAT"));
    };
    drawn({"compare", "weak.toml", "strong.toml", "--frames", "--no-film", "--no-report", "--out", "film"},
          true);
    drawn({"compare", "film/weak", "film/strong", "--at", "0.1", "--out", "still"}, true);
    drawn({"compare", "film/weak", "film/strong", "--at", "0.1", "--set", "film.trails={}", "--out", "none"},
          false);
    const std::string sixth = pixels("film/frames/000006.png");  // 60 frames a second of the run
    EXPECT_TRUE(pixels("still/still-0.100s.png") == sixth);
    EXPECT_FALSE(pixels("none/still-0.100s.png") == sixth);
}

// A caption that a scene has for its own drive is not shown over a panel with another drive.
TEST_F(CompareProgram, CaptionsOfOneValueAreLeftOutBesideOthers) {
    write_text(here / "told.toml",
               text_of(here / "weak.toml") +
                   "[[film.caption]]\nfrom = \"0 s\"\ntext = \"Nothing flies\"\nhold = 0.5\n");
    const auto drawn = [&](const std::string& scene, const std::string& out,
                           const std::vector<std::string>& more) {
        std::vector<std::string> words = {"compare", scene,  "--vary", "drive.g_level=1.2,3",
                                          "--at",    "0.05", "--out",  out};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 0) << ended.err;
        const std::string png = text_of(here / out / "still-0.050s.png");
        return std::pair(ended.err, png.substr(png.find("IDAT")));
    };
    const auto [said, told] = drawn("told.toml", "told", {});
    EXPECT_THAT(said, tells({"film.caption", "one value", "drive.g_level", "left out"}));
    EXPECT_TRUE(told == drawn("weak.toml", "weak", {}).second);
    // The runs have no such caption either, so pictures that are drawn of them later do not.
    const Ended ran = program({"compare", "told.toml", "--vary", "drive.g_level=1.2,3", "--out", "ran",
                               "--no-report", "--set", "film.length=1 s"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_THAT(text_of(here / "ran/told-g_level-3/scene.toml"), Not(HasSubstr("Nothing flies")));
    EXPECT_NEAR(static_cast<double>(decoded_pictures(here / "ran/movie.mp4")), 30, 2)
        << "nothing is held for a caption that is not there";
    const auto [nothing, own] =
        drawn("told.toml", "own", {"--set", "film.caption=[{from=0,text=\"Two drives\"}]"});
    EXPECT_THAT(nothing, Not(HasSubstr("film.caption")));
    EXPECT_NE(own, told);
}

TEST_F(CompareProgram, CaptionsThatAskStayBesideVariedValues) {
    write_text(here / "asks.toml",
               text_of(here / "weak.toml") + "[[film.caption]]\nfrom = \"0 s\"\ntext = \"Do they fly?\"\n");
    const auto still = [&](const std::string& scene) {
        const Ended ended = program(
            {"compare", scene, "--vary", "drive.g_level=1.2,3", "--at", "0.05", "--out", scene + ".d"});
        EXPECT_EQ(ended.status, 0) << ended.err;
        EXPECT_THAT(ended.err, Not(HasSubstr("film.caption")));
        const std::string png = text_of(here / (scene + ".d") / "still-0.050s.png");
        return png.substr(png.find("IDAT"));
    };
    EXPECT_NE(still("asks.toml"), still("weak.toml"));
}

TEST_F(CompareProgram, LeavesThePageOfItsRunsWithTheirFilm) {
    const Ended made = program({"compare", "weak.toml", "strong.toml", "--out", "both"});
    ASSERT_EQ(made.status, 0) << made.err;
    const std::string page = text_of(here / "both/report.html");
    EXPECT_THAT(page, HasSubstr("id=\"film-all\""));
    EXPECT_THAT(page, HasSubstr("id=\"film-bytes-all\""));
    EXPECT_THAT(page, HasSubstr("id=\"bed-bytes-1\""));
    EXPECT_THAT(page, Not(HasSubstr("has no film and no poster")));
    EXPECT_EQ(record_of(here / "both")["status"], "complete");
    // The table says which moment each frame shows, so that beds and film go together.
    const std::string times = text_of(here / "both/film_times.csv");
    EXPECT_EQ(std::count(times.begin(), times.end(), '\n'), 1 + frames_of_film);

    EXPECT_THAT(program({"inspect", "both"}).err, tells({"a film alone", "both/weak, both/strong"}));
    fs::remove(here / "both/report.html");
    const Ended again = program({"report", "both"});
    ASSERT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(again.out, "both/report.html\n");
    EXPECT_TRUE(text_of(here / "both/report.html") == page);

    fs::remove_all(here / "both/strong");
    const Ended gone = program({"report", "both"});
    EXPECT_EQ(gone.status, 2);
    EXPECT_THAT(gone.err, tells({"both/strong", "no longer there"}));
    EXPECT_EQ(program({"compare", "weak.toml", "strong.toml", "--out", "none", "--no-report"}).status, 0);
    EXPECT_FALSE(fs::exists(here / "none/report.html"));
}

// The captions that were given are the names of the runs, in the page, a later page and charts.
TEST_F(CompareProgram, ItsPageCallsTheRunsAsTheirCaptionsDo) {
    const Ended made = program(
        {"compare", "weak.toml", "strong.toml", "--out", "both", "--captions", "by hand <1>|by motor"});
    ASSERT_EQ(made.status, 0) << made.err;
    const std::string page = text_of(here / "both/report.html");
    EXPECT_THAT(page, AllOf(tells({"<h1>Fifty grains:", "by hand &lt;1&gt;, by motor</h1>"}),
                            HasSubstr(">by motor</h2>")));
    fs::remove(here / "both/report.html");
    ASSERT_EQ(program({"report", "both"}).status, 0);
    EXPECT_TRUE(text_of(here / "both/report.html") == page);
    const Ended charts = program({"report", "both", "--charts", "charts", "--measures", "kinetic_J"});
    ASSERT_EQ(charts.status, 0) << charts.err;
    EXPECT_THAT(text_of(here / "charts/kinetic_J.csv"), HasSubstr("by motor"));

    // So is a title of the film.
    ASSERT_EQ(program({"compare", "weak.toml", "strong.toml", "--out", "titled", "--title", "Who flies?",
                       "--captions", "Ada|Bo"})
                  .status,
              0);
    EXPECT_THAT(text_of(here / "titled/report.html"), HasSubstr("<h1>Who flies? Ada, Bo</h1>"));
    // Two of one name do not tell the runs apart.
    ASSERT_EQ(
        program({"compare", "weak.toml", "strong.toml", "--out", "same", "--captions", "run|run"}).status, 0);
    EXPECT_THAT(text_of(here / "same/report.html"), Not(HasSubstr(">run</h2>")));
}

// A length that is asked for holds for the film of all.
TEST_F(CompareProgram, HasTheLengthThatIsAskedFor) {
    const Ended made = program(
        {"compare", "weak.toml", "strong.toml", "--out", "long", "--set", "film.length=2 s", "--no-report"});
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_NEAR(static_cast<double>(decoded_pictures(here / "long/movie.mp4")), 60, 2);
}

TEST_F(CompareProgram, MakesAPdfOfOneMoment) {
    const Ended made =
        program({"compare", "weak.toml", "strong.toml", "--at", "0.05", "--out", "print", "--pdf"});
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_TRUE(text_of(here / "print/still-0.050s.pdf").starts_with("%PDF-"));
    EXPECT_FALSE(fs::exists(here / "print/report.html"));
}

TEST_F(CompareProgram, AllEndWithTheShortest) {
    write("long.toml", "g_level = 2", "0.3 s");
    const Ended ended = program({"compare", "long.toml", "weak.toml", "--out", "both"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, tells({"all are run", "0.2 s"}));
    EXPECT_EQ(decoded_pictures(here / "both/movie.mp4"), frames_of_film);
    EXPECT_NEAR(record_of(here / "both/long")["engine"]["simulated_s"].get<double>(), 0.2, 1e-4);
}

// The slow motion is finer than the step of one panel, so that panel shows each of its frames as often as the
// other panel needs.
TEST_F(CompareProgram, ACoarserStepHoldsItsFrames) {
    for (const std::string step : {"1e-5", "1e-4"}) {
        write(step + ".toml", "g_level = 2", "0.01 s");
        std::string text = text_of(here / (step + ".toml"));
        text.replace(text.find("playback = 0.5"), 14, "playback = 0.0012");  // a frame every 4e-5 s
        text.replace(text.find("overlap = 0.05"), 14, "step = \"" + step + " s\"");
        write_text(here / (step + ".toml"), text);
    }
    const Ended ended = program({"compare", "1e-5.toml", "1e-4.toml", "--out", "both"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(decoded_pictures(here / "both/movie.mp4"), 251);
}

TEST_F(CompareProgram, ForceReplacesAComparison) {
    const std::vector<std::string> words = {"compare", "weak.toml", "weak.toml",  "--out",
                                            "both",    "--force",   "--captions", "one|two"};
    ASSERT_EQ(program(words).status, 0);
    EXPECT_TRUE(fs::exists(here / "both/weak-2/final.csv"));
    const Ended again = program(words);
    EXPECT_EQ(again.status, 0) << again.err;
    write_text(here / "both/weak-2/mine.txt", "mine");
    const Ended refused = program(words);
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.err, HasSubstr("--out both: holds weak-2/mine.txt"));
}

TEST_F(CompareProgram, CtrlCLeavesAFilmThatPlaysAndTheRuns) {
    Program compare({"compare", "weak.toml", "strong.toml", "--duration", "3600 s", "--out", "both"},
                    {here.path(), {}});
    ASSERT_TRUE(wait_until(compare, [&] { return decoded_pictures(here / "both/movie.mp4") >= 10; }));
    compare.send(SIGINT);
    const Ended ended = compare.wait();
    EXPECT_EQ(ended.status, 130) << ended.err;
    const nlohmann::json record = record_of(here / "both");
    EXPECT_EQ(record["status"], "interrupted");
    EXPECT_EQ(decoded_pictures(here / "both/movie.mp4"), record["written"]["film_frames"].get<int>());
    for (const char* name : {"both/weak", "both/strong"}) {
        EXPECT_EQ(record_of(here / name)["status"], "interrupted");
        EXPECT_EQ(read_grain_table(here / name / "final.csv").size(), 50u);
        EXPECT_GT(TrajectoryReader(here / name / "trajectory.nc").frames(), 0u);
    }
}

TEST_F(CompareProgram, ASceneThatBlowsUpEndsAllAndSaysWhichItWas) {
    std::string text = text_of(here / "weak.toml");
    text.replace(text.find("overlap = 0.05"), 14, "step = \"1.2e-3 s\"");
    write_text(here / "wild.toml", text);
    const Ended ended = program({"compare", "weak.toml", "wild.toml", "--out", "both"});
    EXPECT_EQ(ended.status, 1) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("take a smaller run.step"));
    EXPECT_EQ(record_of(here / "both")["status"], "failed");
    EXPECT_EQ(record_of(here / "both/wild")["status"], "failed");
    EXPECT_THAT(record_of(here / "both/wild")["error"], HasSubstr("take a smaller run.step"));
    EXPECT_EQ(record_of(here / "both/weak")["status"], "interrupted");
    EXPECT_TRUE(record_of(here / "both/weak")["error"].is_null());
    EXPECT_EQ(read_grain_table(here / "both/weak/final.csv").size(), 50u);
}

// The exit status is 2, one line says what is wrong, and nothing is on disk.
TEST_F(CompareProgram, MistakesAreRefusedBeforeAnythingIsWritten) {
    write_text(here / "broken.toml", "title = \n");
    write("full.toml", "g_level = 3");
    ASSERT_EQ(program({"movie", "weak.toml", "--no-film", "--out", "run"}).status, 0);
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"compare"}, "compare needs a scene"},
        {{"compare", "weak.toml"}, "compare takes 2 to 6 scenes or folders of runs, not 1"},
        {{"compare", "run", "run", "run", "run", "run", "run", "run"}, "not 7"},
        {{"compare", "weak.toml", "missing.toml"}, "missing.toml: "},
        {{"compare", "weak.toml", "broken.toml"}, "broken.toml:1:"},
        {{"compare", "run", "here"}, "here: "},
        {{"compare", "weak.toml", "strong.toml", "--set", "run.durration=1"}, "durration"},
        {{"compare", "weak.toml", "strong.toml", "--set", "species.small.count=100000"}, "more than"},
        {{"compare", "weak.toml", "strong.toml", "--set", "species.big.diameter=25 mm"}, "diameter"},
        {{"compare", "weak.toml", "strong.toml", "--captions", "a|b|c"}, "--captions: has 3 parts"},
        {{"compare", "weak.toml", "strong.toml", "--size", "64x64"},
         "--size: 64x64 is too small for 2 panels"},
        {{"compare", "weak.toml", "strong.toml", "--no-film"}, "--no-film"},
        {{"compare", "weak.toml", "strong.toml", "--vary", "drive.g_level=1,2"}, "--vary: takes one scene"},
        {{"compare", "weak.toml", "--vary", "drive.g_level"}, "--vary drive.g_level: write KEY=VALUE,VALUE"},
        {{"compare", "weak.toml", "--vary", "drive.g_level=2"}, "--vary drive.g_level: has one value"},
        {{"compare", "weak.toml", "--vary", "drive.g_level=2,"}, "--vary drive.g_level: value 2 is empty"},
        {{"compare", "weak.toml", "--vary", "drive.g_level=2,3,2"}, "--vary drive.g_level: has 2 twice"},
        {{"compare", "weak.toml", "--vary", "drive.g_level=1,2,3,4,5,6,7"}, "--vary: has 7 values"},
        {{"compare", "weak.toml", "--vary", "drive.g_levle=1,2"}, "--vary drive.g_levle: unknown key"},
        {{"compare", "weak.toml", "--vary", "drive.g_level=1,x"}, "--vary drive.g_level: "},
        {{"compare", "weak.toml", "--vary", "drive.frequency=20 Hz,3 mm"},
         "--vary drive.frequency: 'frequency' must be a frequency, but \"3 mm\" is a length"},
        {{"compare", "weak.toml", "--vary", "film.size=64x64,65x65"},
         "--vary film.size: is the same for all panels"},
        {{"compare", "weak.toml", "--vary", "run.duration=1 s,2 s"}, "--vary run.duration: is the same"},
        {{"compare", "weak.toml", "--vary", "drive.g_level=1,2", "--set", "drive.g_level=3"},
         "--vary drive.g_level: --set drive.g_level gives it a value too"},
        {{"compare", "weak.toml", "strong.toml", "--at", "9"}, "--at: 9 s is outside"},
        {{"compare", "weak.toml", "strong.toml", "--at", "0", "--frames"}, "--at"},
        {{"compare", "weak.toml", "strong.toml", "--at", "0", "--format", "png"}, "--format: is of a film"},
        {{"compare", "weak.toml", "strong.toml", "--out", "-"}, "--out -: stdout takes a film in y4m alone"},
        {{"compare", "weak.toml", "strong.toml", "--max-size", "0.3 kB"}, "--max-size: "},
        {{"compare", "run", "weak.toml", "--duration", "1 s"}, "the run is over"},
        {{"compare", "weak.toml", "strong.toml", "--out", "run"}, "--out run: exists already"},
    };
    const auto entries = std::distance(fs::directory_iterator(here.path()), {});
    for (const auto& [words, part] : cases) {
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 2) << testing::PrintToString(words) << ended.err;
        EXPECT_THAT(ended.err, HasSubstr(part)) << testing::PrintToString(words);
        EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
        EXPECT_EQ(ended.out, "");
        EXPECT_EQ(std::distance(fs::directory_iterator(here.path()), {}), entries)
            << testing::PrintToString(words);
    }
}

}  // namespace
}  // namespace grainreel
