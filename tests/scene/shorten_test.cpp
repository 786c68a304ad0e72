// Tests of a run that the command line ends early: parts of the scene that lie later are left out, with a
// message in one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "engine/base/error.hpp"
#include "engine/mesh/room.hpp"
#include "engine/plan/plan.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;

const std::string later_text = wedge_text + R"([[drive.stage]]
from = "0.5 s"
frequency = "40 Hz"
[[drive.stage]]
from = "1 s"
kind = "rest"
[[drive.stage]]
from = "1.5 s"
kind = "taps"
interval = "0.1 s"
amplitude = "2 mm"
[[film.caption]]
from = "0.2 s"
text = "one"
[[film.caption]]
from = "1 s"
text = "two"
[[film.caption]]
from = "1.6 s"
text = "three"
[[feed]]
rate = 1
from = "1.2 s"
)";

const std::string outlet = "container.outlet={ width = \"30 mm\", opens = \"1.4 s\" }";

Assignments until(const std::string& duration) {
    return {outlet, {"run.duration=" + duration, "--duration"}};
}

// If all grains of a species come by feeds, the later ones may be left out, but not all of them.
TEST(Shorten, LeavesOutALaterFeedOfASpeciesThatAnotherOneGives) {
    const std::string poured = test::SmallScene()
                                   .beads(0, "sand", "3 mm")
                                   .box("60 mm", "30 mm", "60 mm")
                                   .lasts("2 s")
                                   .more("[[feed]]\nrate = 100\nuntil = \"0.5 s\"\n[[feed]]\nrate = 100\n")
                                   .more("from = \"1.2 s\"\n")
                                   .text();
    const FilmedScene scene = read_text(poured, {{"run.duration=1 s", "--duration"}});
    ASSERT_EQ(scene.feeds.size(), 1u);
    EXPECT_EQ(scene.feeds.front().from, 0);
    std::string late = poured;
    late.replace(late.find("until = "), std::string("until = \"0.5 s\"").size(), "from = \"1.1 s\"");
    try {
        read_text(late, {{"run.duration=1 s", "--duration"}});
        FAIL() << "a species without grains";
    } catch (const UserError& error) {
        EXPECT_THAT(error.what(), tells({"'from'", "1.1 s", "ends at 1 s"}));
    }
}

TEST(Shorten, LeavesOutWhatComesLaterAndSaysSoInOneLine) {
    const FilmedScene scene = read_text(later_text, until("1 s"));
    EXPECT_EQ(scene.drive.stages.size(), 1u);
    ASSERT_EQ(scene.film.captions.size(), 1u);
    EXPECT_EQ(scene.film.captions[0].to, 1);
    EXPECT_TRUE(scene.feeds.empty());
    EXPECT_EQ(scene.species[0].fed, 0);
    EXPECT_FALSE(scene.container.outlet);
    EXPECT_THAT(scene.notes,
                testing::ElementsAre("--duration: the run ends at 1 s, and goes without what comes later: "
                                     "2 stages of the drive, 1 feed, 1 outlet, 2 captions"));
    EXPECT_EQ(make_plan(scene).warnings.at(0), scene.notes[0]);
    EXPECT_TRUE(read_text(later_text, until("1.9 s")).notes.empty());
}

// The scene that is written can be read again, and then needs nothing of the command line.
TEST(Shorten, AShortenedSceneReadsBack) {
    const FilmedScene scene = read_text(later_text, until("1 s"));
    const FilmedScene again =
        read_filmed_scene_text(resolved_scene(scene, make_plan(scene)), "again.toml", {}, measurable_in);
    EXPECT_EQ(again.drive, scene.drive);
    EXPECT_EQ(again.film.captions, scene.film.captions);
    EXPECT_EQ(again.container, scene.container);
    EXPECT_TRUE(again.notes.empty());
}

// The change from 20 Hz to rest takes three periods, until 1.15 s.
TEST(Shorten, LeavesOutAStageThatWouldNotComeToItsEnd) {
    EXPECT_EQ(read_text(later_text, until("1.07 s")).drive.stages.size(), 1u);
    EXPECT_EQ(read_text(later_text, until("1.2 s")).drive.stages.size(), 2u);
}

TEST(Shorten, EveryShippedSceneMayBeShort) {
    for (const auto& entry : std::filesystem::directory_iterator(GRAINREEL_SOURCE "/scenes")) {
        if (entry.path().extension() != ".toml") continue;
        for (const char* duration : {"run.duration=2 s", "run.duration=2.5 s"})
            EXPECT_NO_THROW(make_plan(read_filmed_scene(entry.path(), {duration}, measurable_in)))
                << entry.path() << " " << duration;
    }
}

TEST(Shorten, NotWhereTheSceneItselfIsWrong) {
    EXPECT_THROW(read_text(with(later_text, "duration = \"2 s\"", "duration = \"1 s\"")), UserError);
    EXPECT_THROW(read_text(with(later_text, "from = \"1 s\"\nkind", "from = \"0.1 s\"\nkind"), until("1 s")),
                 UserError);
    // The species has no other grains.
    const std::string fed = with(later_text, "name = \"small\"\ncount = 100", "name = \"small\"");
    EXPECT_THROW(read_text(fed, until("1 s")), UserError);
}

}  // namespace
}  // namespace grainreel
