// Tests of which moment of the run each frame of the film shows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/measure/columns.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/page/page_film.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// A scene that is shaken at 20 Hz for 1 s. film: the text after [film].
FilmedScene scene_with(const std::string& film) {
    const std::string text = test::SmallScene()
                                 .beads(20, "beads", "4 mm", "2.5 g/cm3")
                                 .box("30 mm", "20 mm", "40 mm")
                                 .shaken("20 Hz", "2")
                                 .lasts("1 s")
                                 .more("[film]\nrate = 30\n")
                                 .text() +
                             film;
    return read_filmed_scene_text(text, "made.toml", {}, measurable_in);
}

// A table that the run itself wrote needs no plan: if a bed lands every second period, frames are left out
// that nobody foresaw.
TEST(FilmTimes, TheRunsOwnTableIsTakenWhereItIsWhole) {
    const test::TemporaryFolder here;
    EXPECT_FALSE(kept_film_times(here.path(), 3));
    FilmTimesTable table;
    State frame;
    for (const double time : {0.0, 0.05, 0.15, 0.25}) {
        frame.time = time;
        table.add(frame, time == 0.05 ? 2 : 1);  // one moment is held for a caption
    }
    table.write(here / kFilmTimes, 4);  // the last picture is not in the film
    const auto kept = kept_film_times(here.path(), 4);
    ASSERT_TRUE(kept);
    EXPECT_THAT(kept->times, testing::ElementsAre(0.0, 0.05, 0.05, 0.15));
    EXPECT_FALSE(kept_film_times(here.path(), 5));
    for (const char* wrong : {"", "frame,step,time_s\n0,0,0\n1,1,nan\n",
                              "frame,step,time_s\n0,0,1\n1,1,0.5\n", "frame,step\n0,0\n1,1\n"}) {
        test::write_text(here / kFilmTimes, wrong);
        EXPECT_FALSE(kept_film_times(here.path(), 2)) << wrong;
    }
}

constexpr const char* locked = "periods = 2\n[[film.segment]]\nkind = \"locked\"\nevery = 2\n";

TEST(FilmTimes, LockedFramesAreWholePeriodsApart) {
    const FilmTimes film = film_times(scene_with(locked), 11, 0, true);
    ASSERT_THAT(film.times, SizeIs(11));
    for (std::size_t k = 0; k < 11; ++k) EXPECT_NEAR(film.times[k], static_cast<double>(k) * 2 / 20, 1e-9);
    EXPECT_EQ(film.why_not.in_english(), "");
}

TEST(FilmTimes, FramesThatHoldACaptionShowItsMoment) {
    const std::string held = R"(
[[film.caption]]
from = "0.4 s"
to = "0.6 s"
text = "look"
hold = "0.1 s"
)";
    const FilmTimes film = film_times(scene_with(locked + held), 11 + 3, 0, true);
    ASSERT_THAT(film.times, SizeIs(14));  // 0.1 s of film are 3 more frames
    for (std::size_t k = 4; k < 8; ++k) EXPECT_NEAR(film.times[k], 0.4, 1e-9);
    EXPECT_NEAR(film.times[8], 0.5, 1e-9);
}

TEST(FilmTimes, AFilmOfAnotherLengthHasNone) {
    const FilmTimes film = film_times(scene_with(locked), 6, 0, true);
    EXPECT_THAT(film.times, IsEmpty());
    EXPECT_THAT(film.why_not.in_english(), HasSubstr("leaves out moments"));
}

TEST(FilmTimes, OfAStoppedRunTheFirstFramesAreKnown) {
    EXPECT_THAT(film_times(scene_with(locked), 6, 0, false).times, SizeIs(6));
    // Here the run may have found that the bed repeats itself every second period, and left out frames.
    const FilmedScene open = scene_with("[[film.segment]]\nkind = \"locked\"\n");
    EXPECT_THAT(film_times(open, 6, 0, false).times, IsEmpty());
}

TEST(FilmTimes, ARunThatWentOnBeginsWhereItDid) {
    const FilmTimes film = film_times(scene_with(locked), 6, 0.5, true);
    ASSERT_THAT(film.times, SizeIs(6));
    EXPECT_NEAR(film.times.front(), 0.5, 1e-9);
}

}  // namespace
}  // namespace grainreel
