// Tests of films of a bed that lands in every second period of the drive.
#include "render/film/sources/period_choice.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/scene/filmed_scene.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr, testing::Not;

const Clock kClock{1e-3, 80, 0};

FilmedScene scene_with(int periods) {
    FilmedScene scene;
    scene.species.resize(1);
    scene.species[0].count = 1;
    scene.species[0].diameter.mean = 1;
    scene.film.periods = periods;
    scene.film.segments.resize(1);
    scene.film.segments[0].kind = FilmSegment::Kind::locked;
    return scene;
}

FilmSegment locked(int every) {
    FilmSegment segment;
    segment.kind = FilmSegment::Kind::locked;
    segment.every = every;
    return segment;
}

std::vector<std::int64_t> shown(const PeriodChoice& bed, const FilmSegment& rule,
                                const std::vector<Due>& shots) {
    std::vector<std::int64_t> steps;
    for (const Due& shot : shots)
        if (bed.shows(rule, shot)) steps.push_back(shot.step);
    return steps;
}

// Runs the bed, which is found in the tenth period to repeat itself every second period.
void run(PeriodChoice& bed, int periods) {
    for (int period = 0; period < periods; ++period)
        bed.note(period * kClock.steps_per_period, period < 10 ? 1 : 2, 0.5);
}

TEST(BedPeriods, LeaveOutLockedFramesInBetween) {
    // The segment begins in period 3, and the next frames count from there.
    const std::vector<Due> all{{250, 0}, {330, 0}, {410, 0}, {490, 0}, {570, 0}};
    PeriodChoice bed(scene_with(0), kClock, all, true);
    EXPECT_THAT(bed.possible(), testing::ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(shown(bed, locked(1), all), testing::ElementsAre(250, 330, 410, 490, 570));
    run(bed, 20);
    EXPECT_EQ(bed.shown(), 2);
    EXPECT_THAT(shown(bed, locked(1), all), testing::ElementsAre(250, 410, 570));
    EXPECT_THAT(shown(bed, FilmSegment{}, all), testing::SizeIs(5)) << "in motion";
    ASSERT_EQ(bed.news().size(), 1u);
    EXPECT_THAT(bed.news()[0], HasSubstr("only every 2 periods"));
    EXPECT_THAT(bed.news()[0], HasSubstr("film.periods = 1"));
    // One frame every second period is already in step with the bed.
    const std::vector<Due> second{{330, 0}, {490, 0}, {650, 0}};
    PeriodChoice bed_of_two(scene_with(0), kClock, second, true);
    run(bed_of_two, 20);
    EXPECT_THAT(shown(bed_of_two, locked(2), second), testing::ElementsAre(330, 490, 650));
}

// In films side by side the other panels may repeat themselves after other numbers of periods.
TEST(BedPeriods, LeaveOutNothingWhereTheyMayNot) {
    const std::vector<Due> all{{0, 0}, {80, 0}, {160, 0}};
    PeriodChoice bed(scene_with(0), kClock, all, false);
    run(bed, 20);
    EXPECT_EQ(bed.shown(), 2);
    EXPECT_THAT(shown(bed, locked(1), all), testing::SizeIs(3));
    EXPECT_THAT(bed.news().at(0), HasSubstr("locked frames jump"));
}

// A film without locked frames, displacements and means gets no message about them.
TEST(BedPeriods, SpeakOnlyOfWhatTheFilmShows) {
    const std::vector<Due> all{{0, 0}, {80, 0}, {160, 0}};
    const auto news = [&](int periods, bool may_leave_out, const auto& change) {
        FilmedScene scene = scene_with(periods);
        change(scene.film);
        PeriodChoice bed(scene, kClock, all, may_leave_out);
        run(bed, 20);
        return bed.news().at(0);
    };
    const auto locked_frames = HasSubstr("locked frames"), means = HasSubstr("means");
    const auto in_motion = [](Film& film) { film.segments[0].kind = FilmSegment::Kind::motion; };
    const auto averaged = [&](Film& film) { in_motion(film), film.segments[0].average = 2; };
    const auto as_is = [](Film&) {};
    for (const int periods : {0, 1}) {
        for (const bool may : {false, true}) {
            EXPECT_THAT(news(periods, may, in_motion), testing::EndsWith("grain diameters)"));
            EXPECT_THAT(news(periods, may, averaged), testing::AllOf(means, testing::Not(locked_frames)));
            EXPECT_THAT(news(periods, may, as_is), testing::AllOf(locked_frames, testing::Not(means)));
        }
    }
    PeriodChoice no_film(scene_with(0), kClock, {}, true);
    run(no_film, 20);
    EXPECT_THAT(no_film.news().at(0), testing::Not(locked_frames));
}

TEST(BedPeriods, AreThoseOfTheSceneWhereItSaysSo) {
    const std::vector<Due> all{{0, 0}, {80, 0}, {160, 0}, {240, 0}, {320, 0}};
    PeriodChoice one(scene_with(1), kClock, all, true), three(scene_with(3), kClock, all, true);
    run(one, 20), run(three, 20);
    EXPECT_THAT(shown(one, locked(1), all), testing::SizeIs(5));
    EXPECT_THAT(one.possible(), testing::ElementsAre(1));
    EXPECT_THAT(shown(three, locked(1), all), testing::ElementsAre(0, 240));
    EXPECT_THAT(one.news().at(0), HasSubstr("locked frames jump"));
}

const std::string bed_scene = SmallScene()
                                  .beads(40, "grain")
                                  .contacts("0.5", "0.4")
                                  .box("15 mm", "15 mm", "60 mm")
                                  .shaken("25 Hz", "4.5")
                                  .lasts("0.8 s")
                                  .more("accuracy = \"draft\"\n[film]\nsize = \"320x240\"\n")
                                  .more("[film.colour]\nby = \"rise\"\n")
                                  .more("[[film.segment]]\nkind = \"locked\"\naverage = 1\n")
                                  .text();

class DoubledBed : public testing::Test {
  protected:
    DoubledBed() { write_text(here / "bed.toml", bed_scene); }
    Ended grainreel(const std::vector<std::string>& words) { return run_program(words, {here.path(), {}}); }
    std::ptrdiff_t pictures(const char* run) {
        return std::distance(std::filesystem::directory_iterator(here / run / "frames"), {});
    }
    TemporaryFolder here;
};

// 20 periods have 21 frames with one for each period. Ten periods are needed to find out.
TEST_F(DoubledBed, IsShownEverySecondPeriod) {
    const Ended ended = grainreel({"movie", "bed.toml", "--frames", "--threads", "1", "--out", "found"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("only every 2 periods"));
    EXPECT_THAT(text_of(here / "found/run.json"), HasSubstr("only every 2 periods"));
    const auto found = pictures("found");
    EXPECT_LT(found, 21);
    EXPECT_GE(found, 11);
    const std::string last = fmt::format("frames/{:06}.png", found - 1);
    EXPECT_THAT(text_of(here / "found/frames/000002.png"), HasSubstr("1 frame a period"));
    EXPECT_THAT(text_of(here / "found" / last), HasSubstr("1 frame every 2 periods"));
    EXPECT_THAT(text_of(here / "found" / last), HasSubstr("mean of 2 periods"));

    const Ended two = grainreel({"movie", "bed.toml", "--frames", "--threads", "2", "--out", "two"});
    ASSERT_EQ(two.status, 0) << two.err;
    EXPECT_EQ(pictures("two"), found);
    EXPECT_EQ(text_of(here / "two/measures.csv"), text_of(here / "found/measures.csv"));
    EXPECT_TRUE(text_of(here / "two" / last) == text_of(here / "found" / last)) << "not the same film";

    const Ended one = grainreel({"movie", "bed.toml", "--frames", "--out", "one", "--set", "film.periods=1"});
    ASSERT_EQ(one.status, 0) << one.err;
    EXPECT_EQ(pictures("one"), 21);
    EXPECT_EQ(text_of(here / "one/measures.csv"), text_of(here / "found/measures.csv"));
}

// A run that goes on tells when the bed began to repeat itself otherwise, not when it went on.
TEST_F(DoubledBed, IsToldFromTheSameTimeByARunThatGoesOn) {
    const auto onset = [&](const char* run) {
        const std::string text = text_of(here / run / "run.json");
        const auto at = text.find(" on the bed repeats itself");
        return at == std::string::npos ? "none" : text.substr(text.rfind('"', at), at - text.rfind('"', at));
    };
    ASSERT_EQ(grainreel({"movie", "bed.toml", "--no-film", "--out", "whole"}).status, 0);
    ASSERT_EQ(grainreel({"movie", "bed.toml", "--no-film", "--out", "parts", "--duration", "0.7 s"}).status,
              0);
    ASSERT_EQ(grainreel({"resume", "parts", "--until", "0.8 s", "--no-film"}).status, 0);
    EXPECT_THAT(onset("whole"), HasSubstr("from 0."));
    EXPECT_EQ(onset("parts"), onset("whole"));
}

TEST_F(DoubledBed, IsDrawnAgainEverySecondPeriod) {
    ASSERT_EQ(grainreel({"movie", "bed.toml", "--no-film", "--out", "run"}).status, 0);
    const Ended ended = grainreel({"render", "run", "--frames", "--out", "again"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(pictures("again"), 11);
    EXPECT_THAT(ended.err, HasSubstr("only every 2 periods"));
    EXPECT_THAT(text_of(here / "again/frames/000000.png"), HasSubstr("1 frame every 2 periods"));
    const Ended all = grainreel({"render", "run", "--frames", "--out", "all", "--set", "film.periods=1"});
    ASSERT_EQ(all.status, 0) << all.err;
    EXPECT_EQ(pictures("all"), 21);
    EXPECT_THAT(all.err, Not(HasSubstr("only every")));
    const Ended fourth = grainreel({"render", "run", "--frames", "--out", "fourth", "--every", "4"});
    ASSERT_EQ(fourth.status, 0) << fourth.err;
    EXPECT_EQ(pictures("fourth"), 6) << "every fourth is in step already";
    const Ended both =
        grainreel({"compare", "run", "run", "--size", "480x270", "--no-film", "--frames", "--out", "both"});
    ASSERT_EQ(both.status, 0) << both.err;
    EXPECT_EQ(pictures("both"), 11) << "the same frames as render";
    EXPECT_THAT(both.err, HasSubstr("only every 2 periods"));
    EXPECT_THAT(text_of(here / "both/frames/000000.png"), HasSubstr("1 frame every 2 periods"));
}

}  // namespace
}  // namespace grainreel
