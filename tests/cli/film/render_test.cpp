// Tests of `grainreel render` as a user sees it: a finished run is drawn again.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>

#include "engine/files/frames/open_frames.hpp"
#include "render/film/sources/recorded_scene.hpp"
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

std::ptrdiff_t entries_of(const fs::path& folder) {
    return std::distance(fs::directory_iterator(folder), {});
}

class RenderProgram : public testing::Test {
  protected:
    Ended program(const std::vector<std::string>& words) { return run_program(words, {here.path(), {}}); }
    // Runs the small scene in run/ with another [[film.segment]] and what follows it. The camera frames the
    // container, because how high the grains get is known only after the run.
    void run(const std::string& segment, const std::vector<std::string>& more) {
        std::string text = small_scene_text;
        text.replace(text.find("[[film.segment]]"), std::string::npos, segment);
        write_text(here / "run.toml", text);
        std::vector<std::string> words = {"movie",      "run.toml", "--out", "run",
                                          "--duration", "0.3 s",    "--set", "film.camera.frame=container"};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = program(words);
        ASSERT_EQ(ended.status, 0) << ended.err;
    }
    void short_run() { run("[[film.segment]]\nkind = \"locked\"\n", {"--no-film"}); }

    TemporaryFolder here;
};

// Compares the PNG files with their words: name, title, time, phase, step and playback.
void expect_same_pictures(const fs::path& a, const fs::path& b) {
    ASSERT_EQ(entries_of(a), entries_of(b));
    for (const fs::directory_entry& entry : fs::directory_iterator(a)) {
        const fs::path other = b / entry.path().filename();
        ASSERT_TRUE(fs::exists(other)) << other;
        EXPECT_TRUE(text_of(entry.path()) == text_of(other)) << other;
    }
}

TEST_F(RenderProgram, DrawsTheLockedFilmOfTheRunToTheByte) {
    run("[[film.segment]]\nkind = \"locked\"\n", {"--frames"});
    const Ended ended = program({"render", "run", "--frames"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out, "run-render\n");
    EXPECT_EQ(decoded_pictures(here / "run-render/movie.mp4"), 7);  // 0.3 s at 20 Hz, both ends included
    expect_same_pictures(here / "run/frames", here / "run-render/frames");
}

// Pictures on the way from one locked moment to the next are made of the moments that the film kept.
TEST_F(RenderProgram, DrawsPicturesBetweenLockedMomentsToTheByte) {
    run("[[film.segment]]\nkind = \"locked\"\nbetween = 2\n", {"--frames"});
    EXPECT_EQ(entries_of(here / "run/frames"), 7 + 2 * 6);
    const Ended ended = program({"render", "run", "--frames"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, testing::Not(HasSubstr("brought back")));
    expect_same_pictures(here / "run/frames", here / "run-render/frames");
    EXPECT_NE(text_of(here / "run/frames/000001.png"), text_of(here / "run/frames/000003.png"));
}

TEST_F(RenderProgram, DrawsACycleAtAPhase) {
    short_run();  // 20 Hz
    ASSERT_EQ(program({"render", "run", "--at", "0.1125", "--out", "at.png"}).status, 0);
    const Ended ended = program({"render", "run", "--cycle", "2", "--phase", "0.25", "--out", "cycle.png"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_TRUE(text_of(here / "at.png") == text_of(here / "cycle.png"));
    const Ended late = program({"render", "run", "--cycle", "40", "--out", "late.png"});
    EXPECT_EQ(late.status, 2);
    EXPECT_THAT(late.err, tells({"--cycle", "40 periods", "which has 6"}));
    EXPECT_EQ(program({"render", "run", "--phase", "0.5"}).status, 2);
    EXPECT_EQ(program({"render", "run", "--cycle", "1", "--at", "0.1"}).status, 2);
}

TEST_F(RenderProgram, DrawsTheFilmInMotionOfTheRunToTheByte) {
    // 0.375 / 30 s is a quarter of a period, which is a whole number of steps.
    run("[[film.segment]]\nplayback = 0.375\n", {"--frames", "--set", "output.trajectory_interval=0.0125"});
    ASSERT_EQ(program({"render", "run", "--frames", "--no-film", "--out", "again"}).status, 0);
    expect_same_pictures(here / "run/frames", here / "again/frames");
    EXPECT_FALSE(fs::exists(here / "again/movie.mp4"));
}

TEST_F(RenderProgram, KeptContactsDrawForceChainsAndTheirColours) {
    run("[[film.segment]]\nkind = \"locked\"\n",
        {"--frames", "--set", "output.contacts=true", "--set", "film.colour.by=coordination"});
    ASSERT_EQ(program({"render", "run", "--frames", "--no-film", "--out", "again"}).status, 0);
    expect_same_pictures(here / "run/frames", here / "again/frames");
    EXPECT_EQ(program({"render", "run", "--at", "0.1", "--set", "film.force_chains=true"}).status, 0);
    ASSERT_EQ(program({"render", "run", "--at", "0.1", "--out", "kept.png"}).status, 0);
    fs::remove(here / "run/contacts.nc");
    ASSERT_EQ(program({"render", "run", "--at", "0.1", "--out", "replayed.png"}).status, 0);
    EXPECT_TRUE(text_of(here / "kept.png") == text_of(here / "replayed.png"));
    const Ended refused = program({"render", "run", "--at", "0.1", "--no-replay"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.err, tells({"no contacts.nc", "not told to keep"}));
}

// How high the grains got in a finished run is known. The picture is the same as that of a scene that gives
// this height.
TEST_F(RenderProgram, FramesWhatTheGrainsReached) {
    short_run();
    const double reach = *known_reach(*open_frames(here / "run/trajectory.nc"));
    const auto still = [&](const std::string& name, const std::string& set) {
        EXPECT_EQ(program({"render", "run", "--at", "0.1", "--out", name, "--set", set}).status, 0);
        return text_of(here / name);
    };
    const std::string known = still("known.png", "film.camera.frame=reach");
    EXPECT_NE(known, still("all.png", "film.camera.frame=container"));
    const std::string said =
        program({"render", "run", "--at", "0.1", "--out", "said.png", "--set", "film.camera.frame=reach",
                 "--set", fmt::format("film.camera.reach={:.17g}", reach)})
                    .status == 0
            ? text_of(here / "said.png")
            : "";
    EXPECT_TRUE(known == said);
}

TEST_F(RenderProgram, FromToAndEveryChooseFrames) {
    short_run();
    const Ended ended =
        program({"render", "run", "--from", "0.1 s", "--to", "0.25", "--every", "2", "--frames"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(entries_of(here / "run-render/frames"), 2);  // of 0.10, 0.15, 0.20 and 0.25 s
    const nlohmann::json record = nlohmann::json::parse(text_of(here / "run-render/run.json"));
    EXPECT_EQ(record["status"], "complete");
    EXPECT_TRUE(record["engine"].is_null());
    ASSERT_EQ(record["drawn"].size(), 1u);
    EXPECT_EQ(record["drawn"][0]["run"], "run");
    EXPECT_EQ(record["drawn"][0]["frames"], 2);
    EXPECT_NEAR(record["drawn"][0]["first_s"].get<double>(), 0.1, 1e-9);
    EXPECT_NEAR(record["drawn"][0]["last_s"].get<double>(), 0.2, 1e-9);
    EXPECT_THAT(text_of(here / "run-render/frames/000000.png"),
                tells({"1 frame every 2 periods", "phase 0", "plays 3×"}));
}

TEST_F(RenderProgram, AnotherSizeAnotherCameraAnotherColour) {
    short_run();
    const std::string size = "480x270";
    ASSERT_EQ(program({"render", "run", "--frames", "--no-film", "--size", size, "--out", "plain"}).status,
              0);
    for (const char* set : {"film.camera.azimuth=70", "species.big.colour=#102030", "film.title=Other"}) {
        const Ended ended = program({"render", "run", "--frames", "--no-film", "--size", size, "--out",
                                     "other", "--force", "--set", set});
        ASSERT_EQ(ended.status, 0) << ended.err;
        EXPECT_NE(text_of(here / "plain/frames/000003.png"), text_of(here / "other/frames/000003.png"))
            << set;
    }
    const Ended clear = program({"render", "run", "--at", "0", "--transparent", "--out", "clear.png"});
    EXPECT_EQ(clear.status, 0) << clear.err;
    EXPECT_EQ(text_of(here / "clear.png")[25], 6) << "colour type of IHDR: with alpha";
    const Ended small = program({"render", "run", "--at", "0", "--size", "200x100", "--out", "one.png"});
    ASSERT_EQ(small.status, 0) << small.err;
    // IHDR has width and height, big-endian, after the signature and the chunk's head.
    EXPECT_EQ(text_of(here / "one.png").substr(16, 8), std::string("\0\0\0\xc8\0\0\0\x64", 8));
}

TEST_F(RenderProgram, TakesBackColoursAndListsOfTheRunAndSaysWhatItLeavesOut) {
    run("[film.colour]\nby = \"speed\"\nmap = \"cividis\"\nunit = \"cm/s\"\n[[film.plot]]\ny = \"lacey\"\n"
        "[[film.segment]]\nkind = \"locked\"\naverage = 2\n",
        {"--no-film"});
    const Ended ended = program({"render", "run", "--at", "0.1", "--set", "film.colour.by=start-height",
                                 "--set", "film.plot=[]", "--no-replay"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, tells({": 'average'", "left out", "single moments"}));
    EXPECT_THAT(program({"render", "run", "--at", "0.1"}).err, Not(HasSubstr("left out: frames")));
    const Ended wrong = program({"render", "run", "--fps", "500"});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_THAT(wrong.err, tells({"error: --fps", "'rate'", "1 to 240"}));
}

TEST_F(RenderProgram, AtDrawsTheNearestKeptFrameWhereItMayNotBringBack) {
    short_run();
    const std::vector<std::string> words = {"render", "run", "--at", "0.17 s", "--no-replay"};
    const Ended ended = program(words);
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out, "run-0.150s.png\n");
    EXPECT_THAT(ended.err, HasSubstr("frame 4 of 7"));
    EXPECT_THAT(ended.err,
                tells({"--at", "0.17 s", "not kept", "--no-replay", "0.15 s", "drawn", "nearest"}));
    EXPECT_THAT(text_of(here / "run-0.150s.png"), HasSubstr("0.15 s"));
    EXPECT_EQ(program(words).out, "run-0.150s-2.png\n");
    EXPECT_EQ(text_of(here / "run-0.150s.png"), text_of(here / "run-0.150s-2.png"));
}

TEST_F(RenderProgram, AStillCanBeAPdf) {
    short_run();
    const Ended ended = program({"render", "run", "--at", "0.15 s", "--pdf", "--width-mm", "85"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out, "run-0.150s.pdf\n");
    const std::string pdf = text_of(here / "run-0.150s.pdf");
    EXPECT_TRUE(pdf.starts_with("%PDF-"));
    for (const char* part : {"/FontFile", "/ToUnicode", "/Width 1004"})  // 85 mm at 300 dpi
        EXPECT_NE(pdf.find(part), std::string::npos) << part;
    // A name that ends in .pdf says it too.
    EXPECT_EQ(program({"render", "run", "--at", "0.15 s", "--out", "x.pdf", "--width-mm", "85"}).status, 0);
    EXPECT_TRUE(text_of(here / "x.pdf") == pdf);
}

// A still of a moment that the film shows is the same as the film's picture, wherever its grains come from.
TEST_F(RenderProgram, AtDrawsAnyMoment) {
    run("[[film.segment]]\nplayback = 0.5\nexposure = \"10 ms\"\n", {"--frames"});
    const std::string picture = text_of(here / "run/frames/000004.png");  // 4 * 0.5 / 30 s
    const auto pixels = [](const std::string& png) { return png.substr(png.find("IDAT")); };
    const auto still = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> words = {"render", "run", "--at", "0.0666666667", "--out", name};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 0) << ended.err;
        return ended.err;
    };
    EXPECT_THAT(still("filmed.png", {}), HasSubstr("film_moments.nc"));
    EXPECT_TRUE(pixels(text_of(here / "filmed.png")) == pixels(picture));
    fs::remove(here / "run/film_moments.nc");
    EXPECT_THAT(still("replayed.png", {"--threads", "2"}), HasSubstr("brought back from a checkpoint"));
    EXPECT_TRUE(pixels(text_of(here / "replayed.png")) == pixels(picture));
    const Ended odd = program({"render", "run", "--at", "0.0625s"});
    EXPECT_EQ(odd.out, "run-0.0625s.png\n");
    EXPECT_THAT(text_of(here / "run-0.0625s.png"), HasSubstr("0.0625 s"));
    fs::remove_all(here / "run/checkpoints");  // the last checkpoint, in another file, remains
    EXPECT_THAT(still("near.png", {}), tells({"no checkpoint", "before 0.3 s", "0.05 s is drawn"}));
    EXPECT_EQ(program({"render", "run", "--at", "0.3", "--out", "end.png"}).status, 0);
}

// The frames are 0.1 s apart, and the moment is half a second after the last of them.
TEST_F(RenderProgram, AtIsRefusedWhereNothingIsNear) {
    short_run();
    fs::remove_all(here / "run/checkpoints");
    const std::string whole = text_of(here / "run/trajectory.nc");
    run("[[film.segment]]\nkind = \"locked\"\n",
        {"--no-film", "--force", "--set", "output.trajectory_interval=1 s"});
    fs::remove_all(here / "run/checkpoints");
    const Ended ended = program({"render", "run", "--at", "0.1"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.err, tells({"--at", "0.1 s", "not kept"}));
    EXPECT_THAT(ended.err, HasSubstr("too far away"));
    EXPECT_EQ(ended.out, "");
}

// With another title there are as many pictures. With the same words the bytes are the same, also if
// everything is restored.
TEST_F(RenderProgram, DrawsTheWholeFilmOnceMore) {
    run("[[film.segment]]\nplayback = 0.5\nduration = 0.1\n[[film.segment]]\nkind = \"locked\"\nphase = "
        "0.25\n"
        "[[film.segment]]\nplayback = 0.25\nexposure = \"10 ms\"\nduration = 0.1\n",
        {"--frames"});
    const auto pictures = entries_of(here / "run/frames");
    const Ended titled = program({"render", "run", "--frames", "--title", "Other", "--out", "titled"});
    ASSERT_EQ(titled.status, 0) << titled.err;
    EXPECT_EQ(entries_of(here / "titled/frames"), pictures);
    EXPECT_THAT(titled.err, Not(HasSubstr("brought back")));
    ASSERT_EQ(program({"render", "run", "--frames", "--out", "again"}).status, 0);
    expect_same_pictures(here / "run/frames", here / "again/frames");
    fs::remove(here / "run/film_moments.nc");
    const Ended back = program({"render", "run", "--frames", "--no-film", "--out", "back", "--threads", "3"});
    EXPECT_EQ(back.status, 0) << back.err;
    EXPECT_THAT(back.err, tells({"pictures", "not kept", "brought back", "checkpoints"}));
    expect_same_pictures(here / "run/frames", here / "back/frames");
    const Ended kept = program({"render", "run", "--frames", "--no-replay", "--out", "kept"});
    EXPECT_EQ(kept.status, 0) << kept.err;
    EXPECT_EQ(entries_of(here / "kept/frames"), 7);  // 0.3 s at 20 Hz, both ends included
    EXPECT_THAT(kept.err, HasSubstr(fmt::format("of the film's {} pictures ", pictures)));
    EXPECT_THAT(kept.err, HasSubstr("--no-replay: nothing is brought back"));
}

// The scene differs only in the seed, so the checkpoints are of another run.
TEST_F(RenderProgram, CheckpointsOfAnotherRunArePassedOver) {
    run("[[film.segment]]\nplayback = 0.5\n", {"--no-film"});
    ASSERT_EQ(
        program({"movie", "run.toml", "--no-film", "--out", "other", "--duration", "0.3 s", "--seed", "7"})
            .status,
        0);
    fs::remove_all(here / "run/checkpoints");
    fs::copy(here / "other/checkpoints", here / "run/checkpoints", fs::copy_options::recursive);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"render", "run"}, {"render", "run", "--at", "0.12"}}) {
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 0) << ended.err;
        EXPECT_THAT(ended.err, tells({"run/checkpoints/000000000000.grs and ",
                                      " more checkpoints: each is of another run"}));
        EXPECT_THAT(ended.err, HasSubstr("nearest"));
    }
    fs::remove_all(here / "run-render");
    const Ended kept = program({"render", "run", "--no-replay"});
    EXPECT_EQ(kept.status, 0) << kept.err;
}

TEST_F(RenderProgram, SegmentsOfItsOwnAreShown) {
    run("[[film.segment]]\nkind = \"locked\"\n", {"--no-film"});
    const auto drawn = [&](const std::string& segments, const std::string& out) {
        const Ended ended = program(
            {"render", "run", "--frames", "--no-film", "--set", "film.segment=" + segments, "--out", out});
        EXPECT_EQ(ended.status, 0) << ended.err;
        return entries_of(here / out / "frames");
    };
    EXPECT_EQ(drawn("[{kind=\"locked\",phase=0.5}]", "half"), 6);  // 0.025 s and every 0.05 s
    EXPECT_THAT(text_of(here / "half/frames/000002.png"), tells({"1 frame a period", "phase 0.5"}));
    EXPECT_THAT(text_of(here / "half/frames/000002.png"), HasSubstr("0.125 s"));
    EXPECT_EQ(drawn("[{playback=0.3}]", "slow"), 31);  // one every 0.3 / 30 s, both ends included
    const Ended cut =
        program({"render", "run", "--frames", "--no-film", "--set", "film.segment=[{playback=0.3}]", "--from",
                 "0.1", "--to", "0.2", "--out", "cut"});
    EXPECT_EQ(cut.status, 0) << cut.err;
    EXPECT_EQ(entries_of(here / "cut/frames"), 11);
}

// Trails in one picture are the same as those in the film of the same frames.
TEST_F(RenderProgram, AtDrawsTrailsOfTheFramesBefore) {
    short_run();
    const std::vector<std::string> trails = {"--set", "film.trails.species=[\"big\"]", "--set",
                                             "film.words=none"};
    const auto with = [&](std::vector<std::string> words) {
        words.insert(words.end(), trails.begin(), trails.end());
        return program(words);
    };
    ASSERT_EQ(with({"render", "run", "--no-film", "--frames", "--out", "film"}).status, 0);
    ASSERT_EQ(with({"render", "run", "--at", "0.3", "--out", "still.png"}).status, 0);
    ASSERT_EQ(
        program({"render", "run", "--at", "0.3", "--set", "film.words=none", "--out", "bare.png"}).status, 0);
    const auto pixels = [](const std::string& png) { return png.substr(png.find("IDAT")); };
    const std::string last = text_of(here / "film/frames/000006.png");
    EXPECT_EQ(pixels(text_of(here / "still.png")), pixels(last));
    EXPECT_NE(pixels(text_of(here / "bare.png")), pixels(last));
}

// Moments that the run did not keep are brought back for the trails, unless that is forbidden.
TEST_F(RenderProgram, AtDrawsTrailsOfMomentsThatWereNotKept) {
    short_run();  // keeps a moment in each period of 50 ms
    const auto drawn = [&](std::vector<std::string> words, const std::string& out) {
        words.insert(words.end(), {"--set", "film.segment=[{playback=0.5}]", "--set",
                                   "film.trails.species=[\"big\"]", "--set", "film.show=[\"time\"]"});
        words.insert(words.end(), {"--out", out});
        EXPECT_EQ(program(words).status, 0) << out;
    };
    drawn({"render", "run", "--no-film", "--frames"}, "film");
    drawn({"render", "run", "--at", "0.2"}, "still.png");
    drawn({"render", "run", "--at", "0.2", "--no-replay"}, "kept.png");
    const auto pixels = [](const std::string& png) { return png.substr(png.find("IDAT")); };
    const std::string twelfth = pixels(text_of(here / "film/frames/000012.png"));
    EXPECT_TRUE(pixels(text_of(here / "still.png")) == twelfth);
    EXPECT_FALSE(pixels(text_of(here / "kept.png")) == twelfth);
}

// The command line puts the camera at another place, or back to the automatic one, whatever scene.toml has.
TEST_F(RenderProgram, ThePlaceOfTheCameraTakesThePlaceOfItsAngles) {
    short_run();
    const Ended placed = program(
        {"render", "run", "--at", "0", "--set", "film.camera.position=[0.2,0.1,0.1]", "--out", "a.png"});
    EXPECT_EQ(placed.status, 0) << placed.err;
    run("[film.camera]\nposition = [0.2, 0.1, 0.1]\n", {"--no-film", "--force"});
    const Ended turned =
        program({"render", "run", "--at", "0", "--set", "film.camera.azimuth=50", "--out", "b.png"});
    EXPECT_EQ(turned.status, 0) << turned.err;
}

TEST_F(RenderProgram, FilesOfAnotherRunAreRefusedAndDamagedOnesTold) {
    run("[[film.segment]]\nkind = \"locked\"\n", {"--no-film", "--set", "output.contacts=true"});
    fs::copy(here / "run", here / "more", fs::copy_options::recursive);
    const std::string text = text_of(here / "more/scene.toml");
    std::string other = text;
    other.replace(other.find("count = 40"), 10, "count = 41");
    write_text(here / "more/scene.toml", other);
    const Ended foreign = program({"render", "more", "--at", "0"});
    EXPECT_EQ(foreign.status, 2);
    EXPECT_THAT(foreign.err, tells({"50 grains", "scene.toml", "51"}));
    other = text;
    other.replace(other.find("diameter = 0.006"), 16, "diameter = 0.005");
    write_text(here / "more/scene.toml", other);
    EXPECT_THAT(program({"render", "more", "--at", "0"}).err, HasSubstr("they are of two runs"));
    write_text(here / "more/scene.toml", text);
    const Ended turning = program({"render", "more", "--at", "0", "--set", "film.rotation=true"});
    EXPECT_EQ(turning.status, 2);
    EXPECT_THAT(turning.err, HasSubstr("has no orientations"));
    EXPECT_EQ(program({"render", "more", "--at", "9"}).status, 2);
    fs::resize_file(here / "more/contacts.nc", fs::file_size(here / "more/contacts.nc") / 2);
    const Ended cut =
        program({"render", "more", "--at", "0.1", "--set", "film.force_chains=true", "--out", "c.png"});
    EXPECT_EQ(cut.status, 0);
    EXPECT_THAT(cut.err, HasSubstr("contacts.nc: was cut off"));
}

// A run that was killed while it wrote a frame leaves such a file.
TEST_F(RenderProgram, ALastFrameThatIsNotWholeIsLeftOut) {
    short_run();
    ASSERT_EQ(program({"render", "run", "--no-film", "--frames", "--out", "all"}).status, 0);
    fs::resize_file(here / "run/trajectory.nc", fs::file_size(here / "run/trajectory.nc") - 100);
    const Ended ended = program({"render", "run", "--no-film", "--frames", "--out", "cut", "--no-replay"});
    EXPECT_EQ(ended.status, 0);
    EXPECT_THAT(ended.err, tells({"run/trajectory.nc", "frame 6", "not whole", "left"}));
    EXPECT_EQ(entries_of(here / "cut/frames"), entries_of(here / "all/frames") - 1);
    ASSERT_EQ(program({"render", "run", "--no-film", "--frames", "--out", "back"}).status, 0);
    expect_same_pictures(here / "all/frames", here / "back/frames");
}

TEST_F(RenderProgram, AStartFileThatIsGoneDoesNotMatter) {
    short_run();
    ASSERT_EQ(program({"movie", "run.toml", "--out", "second", "--no-film", "--duration", "0.1 s", "--set",
                       "start.method=file", "--set", "start.file=run/checkpoint.grs"})
                  .status,
              0);
    fs::remove(here / "run/checkpoint.grs");
    const Ended ended = program({"render", "second"});
    EXPECT_EQ(ended.status, 0) << ended.err;
}

TEST_F(RenderProgram, CtrlCLeavesAFilmThatPlays) {
    run("[[film.segment]]\nplayback = 0.1\n", {"--no-film", "--set", "output.trajectory_interval=0.0003"});
    Program render({"render", "run", "--size", "1280x720", "--every", "1"}, {here.path(), {}});
    ASSERT_TRUE(wait_until(render, [&] { return decoded_pictures(here / "run-render/movie.mp4") >= 30; }));
    render.send(SIGINT);
    const Ended ended = render.wait();
    EXPECT_EQ(ended.status, 130) << ended.err;
    const nlohmann::json record = nlohmann::json::parse(text_of(here / "run-render/run.json"));
    EXPECT_EQ(record["status"], "interrupted");
    const int frames = record["written"]["film_frames"].get<int>();
    EXPECT_EQ(decoded_pictures(here / "run-render/movie.mp4"), frames);
    EXPECT_GE(frames, 30);
    EXPECT_LT(frames, 1000);
}

// The exit status is 2, one line says what is wrong, and nothing is on disk.
TEST_F(RenderProgram, MistakesAreRefusedBeforeAnythingIsWritten) {
    short_run();
    fs::create_directory(here / "empty");
    fs::copy(here / "run", here / "cut");
    const std::string whole = text_of(here / "run/trajectory.nc");
    write_text(here / "cut/trajectory.nc", whole.substr(0, whole.size() * 3 / 4));
    fs::copy(here / "run", here / "silent");
    fs::remove(here / "silent/trajectory.nc");
    write_text(here / "taken.png", "mine");
    write_text(here / "empty.dump", "");
    write_text(here / "note.txt", "Buy sand.\n");
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"render"}, "RUN is required"},
        {{"render", "nowhere"}, "nowhere: no such folder; give the folder of a run"},
        {{"render", "run.toml"},
         "run.toml: is a file; give the folder of a run, or run the scene: grainreel movie run.toml"},
        {{"render", "empty.dump"},
         "empty.dump: is an empty file; give the folder of a run, or files of other programs: LAMMPS,"},
        {{"render", "note.txt", "--radius", "2 mm"}, "note.txt: is a file of no format that is read here"},
        {{"render", "run/checkpoint.grs"},
         "run/checkpoint.grs: is a checkpoint (checkpoint.grs); give the folder of its run"},
        {{"render", "empty"}, "empty: has no scene.toml"},
        {{"render", "silent"}, "silent: has no trajectory.nc"},
        {{"render", "cut"}, "cut/trajectory.nc: was cut off: of its 7 frames 4 are whole"},
        {{"render", "run", "--set", "drive.frequency=3"}, "--set drive.frequency: the run is over"},
        {{"render", "run", "--set", "species.big.count=3"}, "the run is over"},
        {{"render", "run", "--set", "film.shade=3"}, "unknown key"},
        {{"render", "run", "--from", "1 s"}, "--from: 1 s is outside the run, which goes from 0 to 0.3 s"},
        {{"render", "run", "--from", "1 s", "--every", "1"},
         "--from: 1 s is outside the run, which goes from 0 to 0.3 s"},
        {{"render", "run", "--from=-1 s"}, "--from: -1 s is outside the run"},
        {{"render", "run", "--to", "9 s"}, "--to: 9 s is outside the run"},
        {{"render", "run", "--from", "0.2 s", "--to", "0.1 s"}, "--from: 0.2 s is later than --to, 0.1 s"},
        {{"render", "run", "--from", "0.11 s", "--to", "0.12 s", "--every", "1"},
         "--from: no frame of the run lies there; they go from 0 to 0.3 s"},
        {{"render", "run", "--every", "2", "--set", "film.segment=[{}]"},
         "--set film.segment: --every draws the frames of the trajectory"},
        {{"render", "run", "--at", "0", "--format", "png"}, "--format: is of a film"},
        {{"render", "run", "--at", "0", "--sheet", "2x2"}, "--sheet: is of a film"},
        {{"render", "run", "--at", "0", "--fps", "20"}, "--fps: is of a film"},
        {{"render", "run", "--at", "0", "--set", "film.quality=3"}, "--set film.quality: is of a film"},
        {{"render", "run", "--at", "0", "--out", "-"}, "--out -: with --at, name a file"},
        {{"render", "run", "--at", "0.4"}, "--at: 0.4 s is outside the run"},
        {{"render", "run", "--transparent"}, "--transparent"},
        {{"render", "run", "--to", "3 kg"}, "--to must be a time, but \"3 kg\" is a mass"},
        {{"render", "run", "--every", "0"}, "--every"},
        {{"render", "run", "--at", "0", "--from", "0"}, "--at"},
        {{"render", "run", "--no-film"}, "--no-film"},
        {{"render", "run", "--out", "run", "--force"}, "--out run: is the run that is drawn"},
        {{"render", "run", "--out", "run/", "--force"}, "is the run that is drawn"},
        {{"render", "run", "--out", "empty/..", "--force"}, "--out"},
        {{"render", "run", "--at", "0", "--out", "taken.png"}, "--out taken.png: exists already"},
        {{"render", "run", "--at", "0", "--out", "gone/x.png"}, "there is no folder gone"},
        {{"render", "run", "--at", "0", "--out", "x.jpg"}, "ends in .png or .pdf"},
        {{"render", "run", "--at", "0", "--pdf", "--out", "x.png"},
         "with --pdf, name a file that ends in .pdf"},
        {{"render", "run", "--pdf"}, "--pdf: is for one picture; add --at"},
    };
    const auto entries = entries_of(here.path()), of_run = entries_of(here / "run");
    for (const auto& [words, part] : cases) {
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 2) << testing::PrintToString(words) << ended.err;
        EXPECT_THAT(ended.err, HasSubstr(part)) << testing::PrintToString(words);
        EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
        EXPECT_EQ(ended.out, "");
        EXPECT_EQ(entries_of(here.path()), entries) << testing::PrintToString(words);
        EXPECT_EQ(entries_of(here / "run"), of_run) << testing::PrintToString(words);
    }
    EXPECT_EQ(text_of(here / "taken.png"), "mine");
}

}  // namespace
}  // namespace grainreel
