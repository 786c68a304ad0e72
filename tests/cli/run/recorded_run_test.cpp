// Tests of runs on disk as sources of frames: what they supply, files that do not belong together, files that
// lack something, and files that grow.
#include "render/film/sources/stored_shots.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/base/error.hpp"
#include "render/picture/base/shot.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::AllOf;
using testing::HasSubstr;

class Recorded : public testing::Test {
  protected:
    Recorded() { write_small_scene(here.path()); }
    Ended program(const std::vector<std::string>& words) { return run_program(words, {here.path(), {}}); }
    // Makes a run in the folder `name` that keeps all it can. It is of the small scene with other values for
    // some keys.
    void run(const std::string& name, const std::vector<std::string>& sets = {}) {
        std::vector<std::string> words = {"movie", "fifty.toml", "--no-film",           "--out",
                                          name,    "--set",      "output.contacts=true"};
        for (const std::string& set : sets) words.insert(words.end(), {"--set", set});
        const Ended ended = program(words);
        ASSERT_EQ(ended.status, 0) << ended.err;
    }
    // Replaces a file of run/ by that of other/.
    void mix(const char* file) {
        fs::remove_all(here / "mixed");
        fs::copy(here / "run", here / "mixed");
        fs::copy(here / "other" / file, here / "mixed" / file, fs::copy_options::overwrite_existing);
    }
    void edit_scene(const std::string& from, const std::string& to) {
        fs::remove_all(here / "mixed");
        fs::copy(here / "run", here / "mixed");
        std::string text = text_of(here / "mixed/scene.toml");
        ASSERT_NE(text.find(from), std::string::npos) << text;
        text.replace(text.find(from), from.size(), to);
        write_text(here / "mixed/scene.toml", text);
    }
    // Expects that all verbs that draw refuse the run in one line and write nothing.
    void expect_refused(const testing::Matcher<std::string>& words) {
        for (const std::vector<std::string>& command :
             {std::vector<std::string>{"render", "mixed", "--at", "0.1", "--set", "film.force_chains=true"},
              {"render", "mixed", "--set", "film.force_chains=true", "--out", "film"},
              {"compare", "run", "mixed", "--size", "480x270", "--set", "film.force_chains=true", "--out",
               "film"}}) {
            const Ended ended = program(command);
            EXPECT_EQ(ended.status, 2) << testing::PrintToString(command);
            EXPECT_THAT(ended.err, AllOf(words, HasSubstr("they are of two runs")));
            EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
            EXPECT_FALSE(fs::exists(here / "film"));
        }
    }

    TemporaryFolder here;
};

TEST_F(Recorded, AnotherRunsTrajectoryIsRefused) {
    run("run");
    run("other", {"drive.frequency=25 Hz"});
    mix("trajectory.nc");
    expect_refused(AllOf(HasSubstr("mixed/trajectory.nc: frame "), HasSubstr("scene.toml beside it")));
}

TEST_F(Recorded, AnEditedSceneIsRefused) {
    run("run");
    const auto trajectory = AllOf(HasSubstr("mixed/trajectory.nc: "), HasSubstr("scene.toml beside it"));
    edit_scene("frequency = 20", "frequency = 21");
    expect_refused(AllOf(trajectory, tells({"1 periods", "at 0.05 s"}), HasSubstr("has 21 Hz")));
    // The drive reaches 2 g at 20 Hz in three periods; after one of them the speed has this share.
    const double u = 1.0 / 3, share = u * u * u * (10 + u * (6 * u - 15));
    const double speed = share * 2 * 9.81 / (2 * std::numbers::pi * 20);
    edit_scene("amplitude = 0.", "amplitude = 0.1");
    expect_refused(AllOf(trajectory, HasSubstr("frame 1 has the floor "),
                         HasSubstr(fmt::format("at {:.4g} m/s, but", speed))));
    edit_scene("phase = 0.0", "phase = 0.25");
    expect_refused(AllOf(trajectory, tells({"frame 0", "phase 0", "0 periods"})));
    edit_scene("step = ", "step = 1e-5 #");
    expect_refused(AllOf(trajectory, HasSubstr("a step is 1e-05 s")));
    edit_scene("count = 40", "count = 41");
    expect_refused(AllOf(trajectory, tells({"50 grains", "scene.toml", "51"})));
    edit_scene("diameter = 0.006", "diameter = 0.005");
    expect_refused(trajectory);
    // There are as many grains with the same sizes, but other numbers of each.
    std::string text = text_of(here / "run/scene.toml");
    text.replace(text.find("count = 40"), 10, "count = 39");
    text.replace(text.find("count = 10"), 10, "count = 11");
    write_text(here / "mixed/scene.toml", text);
    expect_refused(AllOf(trajectory, HasSubstr("has 40 grains of 'small'")));
}

// The scene differs only in the seed, so only the grains' motion tells the runs apart.
TEST_F(Recorded, AnotherRunsMeasuresAndContactsAreRefused) {
    run("run");
    run("other", {"run.seed=2"});
    mix("measures.csv");
    expect_refused(AllOf(HasSubstr("mixed/measures.csv: has the centre of "), HasSubstr("trajectory.nc")));
    mix("contacts.nc");
    expect_refused(AllOf(HasSubstr("mixed/contacts.nc: has grains "), HasSubstr("trajectory.nc")));
    fs::remove_all(here / "other");
    run("other", {"run.overlap=0.02"});
    mix("measures.csv");
    expect_refused(AllOf(HasSubstr("mixed/measures.csv: its last row has "), HasSubstr("a step is")));
}

TEST_F(Recorded, MeasuresThatAreMissingOrEmptyAreNamed) {
    run("run", {"film.plot=[{y=\"lacey\"}]", "film.text=mixing {lacey}", "film.size=640x360"});
    const std::string file = (fs::path("run") / "measures.csv").string();
    const std::string header =
        text_of(here / "run/measures.csv").substr(0, 4 + text_of(here / "run/measures.csv").find('\n'));
    const auto drawn = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"render", "run", "--at", "0.1", "--out", "still.png", "--force"};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 0) << ended.err;
        return ended.err;
    };
    EXPECT_THAT(drawn({}), Not(HasSubstr("measures.csv")));
    write_text(here / "run/measures.csv", header);
    EXPECT_THAT(drawn({}), HasSubstr(file + ": holds no row; plots and live words are left out"));
    write_text(here / "run/measures.csv", "");
    EXPECT_THAT(drawn({"--set", "film.text="}), HasSubstr(file + ": holds no row; plots are left out"));
    fs::remove(here / "run/measures.csv");
    EXPECT_THAT(drawn({"--set", "film.plot=[]"}), HasSubstr(file + ": is missing; live words are left out"));
    const std::string without = text_of(here / "still.png");
    EXPECT_THAT(drawn({"--set", "film.plot=[]", "--set", "film.text="}), Not(HasSubstr("measures.csv")));
    EXPECT_TRUE(text_of(here / "still.png") == without) << "left out, not left empty";
    const Ended both = program({"compare", "run", "run", "--size", "640x360", "--out", "both"});
    EXPECT_EQ(both.status, 0) << both.err;
    EXPECT_THAT(both.err, HasSubstr(file + ": is missing; plots and live words are left out"));
}

TEST_F(Recorded, GivesItsFramesInAnyOrder) {
    run("run", {"film.colour.by=displacement", "film.force_chains=true", "film.text=mixing {lacey}"});
    StoredShots film(here / "run", {}, false);
    const StateArchive& archive = film.run();
    EXPECT_FALSE(film.has_any_moment());
    EXPECT_TRUE(archive.supply().contacts && archive.supply().measures && !archive.supply().orientations);
    ASSERT_EQ(archive.moments().size(), 5u);  // 0.2 s at 20 Hz
    EXPECT_EQ(film.span().from, 0);
    EXPECT_NEAR(film.span().to, 0.2, 1e-12);
    EXPECT_EQ(archive.nearest(-3), 0u);
    EXPECT_EQ(archive.nearest(0.07), 1u);
    EXPECT_EQ(archive.nearest(0.08), 2u);
    EXPECT_EQ(archive.nearest(9), 4u);

    // A frame is the same whoever asks for it and whatever frame was read before.
    const auto go_on = [] { return true; };
    const auto shown = [&](std::size_t index) {
        film.start({{archive.moments()[index].step, 0}}, {FilmSegment()});
        return *film.next(go_on)->frame;
    };
    const Shot last = shown(4), first = shown(0), again = shown(4);
    EXPECT_EQ(last.position, again.position);
    EXPECT_EQ(last.displacement, again.displacement);
    EXPECT_EQ(last.displacement.size(), 50u);
    EXPECT_TRUE(first.displacement.empty()) << "there is nothing a period before";
    EXPECT_FALSE(last.touches.empty());
    EXPECT_EQ(last.measure_rows, 4u * 8 + 1);  // eight a period
    EXPECT_EQ(first.measure_rows, 1u);
    const State before = archive.grains(3);
    EXPECT_EQ(archive.grains(4).position, last.position);
    EXPECT_EQ(last.displacement[7], (last.position[7] - before.position[7]).eval());

    const Pictures pictures{{{0.06, 0}, {0.19, 0}}, {FilmSegment()}, false};
    EXPECT_EQ(film.moments(pictures).at(1).step, last.step);
    film.start(pictures);
    EXPECT_EQ(film.next(go_on)->frame->step, archive.moments()[1].step);
    const std::optional<Taken> picture = film.next(go_on);
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->frame->position, last.position);
    EXPECT_EQ(picture->frame->displacement, last.displacement);
    EXPECT_EQ(picture->frame->touches.size(), last.touches.size());
    EXPECT_FALSE(film.next(go_on)) << "there are only two";
}

// A record that has every moment of a mean gives the mean.
TEST_F(Recorded, GivesMeansAndExposuresWhereItHasTheirMoments) {
    run("run", {"output.trajectory_interval=0.003125"});  // 16 a period
    StoredShots record(here / "run", {}, false);
    FilmSegment mean, exposed;
    mean.average = 1;
    exposed.exposure = 0.0125;
    exposed.exposures = 4;
    record.start({{{0.15, 1}, {0.2, 0}}, {mean, exposed}, false});
    const auto go_on = [] { return true; };
    const Shot four = *record.next(go_on)->frame, averaged = *record.next(go_on)->frame;
    const StateArchive& archive = record.run();
    const std::size_t at = archive.nearest(0.2);
    Vec3 expected = Vec3::Zero();
    for (std::size_t k = 0; k < 16; ++k) expected += archive.grains(at - k).position[7] / 16;
    EXPECT_LT((averaged.position[7] - expected).norm(), 1e-12);
    EXPECT_LT(averaged.container().place.norm(), 1e-6) << "the drive goes round";
    ASSERT_EQ(four.exposed.size(), 3u);
    EXPECT_EQ(four.exposed[2]->position, archive.grains(archive.nearest(0.15) - 1).position);
}

// All that is whole is read while the run goes on: each frame with its contacts and its row of measures.
TEST_F(Recorded, IsReadWhileItGrows) {
    Program movie(
        {"movie", "fifty.toml", "--no-film", "--out", "run", "--duration", "3600 s", "--set",
         "output.contacts=true", "--set", "drive.g_level=0.5", "--set", "output.trajectory_interval=0.002",
         "--set", "film.force_chains=true", "--set", "film.text=mixing {lacey}"},
        {here.path(), {}});
    const auto frames = [&]() -> std::size_t {
        try {
            return StoredShots(here / "run", {}, false).run().moments().size();
        } catch (const UserError&) {
            return 0;  // there is no frame yet
        }
    };
    ASSERT_TRUE(wait_until(movie, [&] { return frames() > 5; }));
    std::size_t first = 0, last = 0;
    for (int turn = 0; turn < 20; ++turn) {
        StoredShots record(here / "run", {}, false);
        record.check_all();
        EXPECT_THAT(record.news(), Not(testing::Contains(HasSubstr("damaged:"))));
        last = record.run().moments().size();
        if (turn == 0) first = last;
        record.start({{record.run().moments()[last - 1].step, 0}}, {FilmSegment()});
        const Shot frame = *record.next([] { return true; })->frame;
        EXPECT_FALSE(frame.touches.empty()) << "frame " << last - 1;
        const double row = record.run().moments()[last - 1].time / (0.05 / 8);  // the last row at that time
        EXPECT_GE(static_cast<double>(frame.measure_rows), row - 1e-6);
    }
    const Ended film = program({"render", "run", "--out", "film", "--every", "100"});
    EXPECT_EQ(film.status, 0) << film.err;
    movie.send(SIGKILL);
    movie.wait();
    EXPECT_GT(last, first) << "it did not grow";
}

// No scene is run, and the progress line says so.
TEST_F(Recorded, ComparedIsDrawingAlone) {
    run("run");
    const Ended ended = program(
        {"compare", "run", "run", "--out", "both", "--size", "480x270", "--progress", "json", "--no-replay"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    std::istringstream lines(ended.err);
    int shown = 0;
    for (std::string line; std::getline(lines, line);) {
        const nlohmann::json object = nlohmann::json::parse(line);
        if (object["event"] != "progress" || object["stage"] == "page") continue;
        ++shown;
        EXPECT_EQ(object["stage"], "drawing") << line;
        EXPECT_EQ(object["frames_planned"], 5);
    }
    EXPECT_GT(shown, 0);
}

// A scene is beside a finished run, and the run may not be replayed. So the scene shows no means either.
TEST_F(Recorded, WhatAMixedFilmLeavesOutIsNamed) {
    run("run");
    const Ended ended = program({"compare", "run", "fifty.toml", "--out", "both", "--size", "480x270",
                                 "--no-replay", "--set", "film.segment=[{kind=\"locked\",average=1}]"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, tells({"'average'", "left out", "single moments"}));
}

}  // namespace
}  // namespace grainreel
