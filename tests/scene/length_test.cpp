// Tests of film.length, and of the pace of films without segments.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/scene/bed.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;

std::string complaint(const std::string& text, const Assignments& sets = {}) {
    try {
        read_text(text, sets);
        return "accepted";
    } catch (const UserError& error) {
        return error.what();
    }
}

// s: how long the film plays by its segments, in which a locked frame takes 1/30 s.
double plays(const FilmedScene& scene) {
    double given = 0, seconds = 0;
    for (const FilmSegment& segment : scene.film.segments) given += segment.duration.value_or(0);
    for (const FilmSegment& segment : scene.film.segments) {
        const double lasts = segment.duration.value_or(scene.run.duration - given);
        seconds += segment.kind == FilmSegment::Kind::motion ? lasts / segment.playback
                                                             : lasts * scene.drive.frequency / segment.every *
                                                                   (segment.between + 1) / scene.film.rate;
    }
    for (const FilmCaption& caption : scene.film.captions) seconds += caption.hold;
    return seconds;
}

TEST(FilmLength, DecidesThePlaybackThatNoSegmentGives) {
    const std::string segments =
        "[[film.segment]]\nduration = 0.5\n[[film.segment]]\nkind = \"locked\"\nevery = 2\nbetween = 1\n"
        "[[film.segment]]\nduration = 0.5\nplayback = 0.25\n"
        "[[film.caption]]\nfrom = 1\ntext = \"look\"\nhold = \"3 s\"\n";
    const FilmedScene scene = read_text(wedge_text + segments, {"film.length=15 s", "film.rate=30"});
    EXPECT_NEAR(plays(scene), 15, 1e-9);
    EXPECT_EQ(scene.film.segments[2].playback, 0.25);
    EXPECT_LT(scene.film.segments[0].playback, 0.25);
    EXPECT_THAT(complaint(wedge_text + segments, {"film.length=2 s"}),
                tells({"'length'", "is 2 s", "3 s", "captions"}));
    EXPECT_THAT(complaint(wedge_text + segments, {"film.length=3.5 s"}),
                tells({"'length'", "is 3.5 s", "write more"}));
}

TEST(FilmLength, ScalesAllMotionWhereEachSegmentHasAPlayback) {
    const std::string segments =
        "[[film.segment]]\nduration = 0.5\nplayback = 0.1\n[[film.segment]]\nplayback = 0.3\n";
    const FilmedScene scene = read_text(wedge_text + segments, {"film.length=40 s"});
    EXPECT_NEAR(plays(scene), 40, 1e-9);
    EXPECT_NEAR(scene.film.segments[1].playback / scene.film.segments[0].playback, 3, 1e-9);
    EXPECT_THAT(complaint(wedge_text + "[[film.segment]]\nkind = \"locked\"\n", {"film.length=10 s"}),
                tells({"'length'", "segment in motion"}));
}

// Without segments, slow motion at both ends takes what locked frames leave; a film that is too short for one
// frame a period has one every second period.
TEST(FilmLength, OfAFilmWithoutSegmentsDecidesItsSlowMotion) {
    for (const char* length :
         {"film.length=12 s", "film.length=30 s", "film.length=4 s", "film.length=300 s"}) {
        const FilmedScene scene = read_text(wedge_text, {length, "run.duration=10", "film.rate=30"});
        EXPECT_NEAR(plays(scene), std::stod(std::string(length).substr(12)), 1e-9) << length;
    }
    EXPECT_THAT(complaint(wedge_text, {"film.length=0.1 s", "run.duration=10"}),
                tells({"'length'", "too short"}));
}

TEST(FilmLength, IsKeptInTheSegmentsOfTheRun) {
    const FilmedScene scene = read_text(wedge_text, {"film.length=12 s"});
    const FilmedScene back = read_filmed_scene_text(resolved_scene(scene, make_plan(scene)), "scene.toml");
    EXPECT_EQ(back.film.segments, scene.film.segments);
}

// Without a drive a grain takes a fifth of a second of film to fall its diameter, or the film half a minute.
TEST(Reader, AFilmWithoutADriveIsSlowedUntilFallingGrainsCanBeFollowed) {
    const std::string falling = with(box_text, "gravity = 0", "gravity = 9.81");
    const FilmedScene scene = read_text(falling, {"run.duration=1"});
    const double falls = std::sqrt(2 * mean_diameter(scene) / 9.81);  // s
    ASSERT_EQ(scene.film.segments.size(), 1u);
    EXPECT_DOUBLE_EQ(scene.film.segments[0].playback, falls / 0.2);
    EXPECT_DOUBLE_EQ(read_text(falling, {"run.duration=20"}).film.segments[0].playback, 20.0 / 30);
    EXPECT_EQ(read_text(falling, {"run.duration=60"}).film.segments[0].playback, 1);
}

}  // namespace
}  // namespace grainreel
