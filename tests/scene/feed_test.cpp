// Tests of [[feed]] and of a start by rain: what they mean, how they are written back, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/plan/plan.hpp"
#include "engine/plan/plan_bed.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells_only;

// The wedge scene, whose [[feed]] begins in line 28.
std::string fed(const std::string& feed) {
    return wedge_text + "[[feed]]\n" + feed;
}

TEST(FeedKeys, DueIsRateTimesTime) {
    const Feed feed = read_text(fed("rate = 30\nfrom = 0.5\ncount = 40\nspecies = \"big\"\n")).feeds.at(0);
    EXPECT_EQ(feed.species, 1u);
    EXPECT_EQ(feed.due(0.5), 0);
    EXPECT_EQ(feed.due(0.5 + 1.0 / 30), 1);
    EXPECT_EQ(feed.due(1.5), 30);
    EXPECT_EQ(feed.due(9), 40);
    Feed until = feed;
    until.until = 1.0;
    EXPECT_EQ(until.due(9), 15);
    until.rate = 1e15;
    until.count.reset();
    EXPECT_GT(until.due(9), std::int64_t{1} << 31) << "more than can be numbered, and no overflow";
}

TEST(FeedKeys, CountAndUntilMakeARate) {
    const FilmedScene scene = read_text(fed("count = 30\nfrom = 0.5\nuntil = 2\n"));
    EXPECT_DOUBLE_EQ(scene.feeds.at(0).rate, 20);
    EXPECT_EQ(scene.species[0].all(), 130);
    EXPECT_EQ(scene.grains(), 140);
    EXPECT_EQ(scene.grains_at_start(), 110);
}

// The box is as wide as the container, and begins three diameters below the top.
TEST(FeedKeys, TheBoxIsBelowTheTop) {
    const Feed feed = read_text(fed("rate = 1\n")).feeds.at(0);
    EXPECT_TRUE(feed.low.isApprox(Vec3(-0.0225, -0.055, 0.18 - 0.015)));
    EXPECT_TRUE(feed.high.isApprox(Vec3(0.0225, 0.055, 0.18)));
}

TEST(FeedKeys, ReadBackAsTheyWereWritten) {
    const std::string text =
        with(fed("rate = 30\nvelocity = [0, 0, -1]\n[[feed]]\nspecies = \"big\"\ncount = 7\n"
                 "until = 1\nlow = [0, 0, 0.1]\nhigh = [0.01, 0.01, 0.12]\n"),
             "[run]", "[start]\nmethod = \"rain\"\nrain_rate = 500\n[run]");
    const FilmedScene scene = read_text(text);
    const FilmedScene again = read_text(resolved_scene(scene, make_plan(scene)));
    EXPECT_EQ(again.feeds, scene.feeds);
    EXPECT_EQ(again.start, scene.start);
    EXPECT_EQ(again.species, scene.species);
}

TEST(FeedKeys, AFedSpeciesNeedsNoCount) {
    const FilmedScene scene = read_text(with(fed("rate = 30\nspecies = \"big\"\n"), "count = 10\n", ""));
    EXPECT_EQ(scene.species[1].count, 0);
    EXPECT_EQ(scene.species[1].all(), 60);
    const FilmedScene again = read_text(resolved_scene(scene, make_plan(scene)));
    EXPECT_EQ(again.species, scene.species);
}

// Expected impacts are those of a fall from the highest place to the floor, and of a floor that comes up.
TEST(FeedKeys, AFallDecidesTheStiffness) {
    const FilmedScene scene = read_text(fed("rate = 1\nvelocity = [0, 0, \"-3 m/s\"]\n"));
    EXPECT_DOUBLE_EQ(make_plan(scene).impact_speed, std::sqrt(9 + 2 * 10 * 0.18) + scene.drive.speed());
}

// The rate fills a twentieth of the layer in the time that a grain falls through it: solid volume per area
// and time = 0.05 x depth of the layer / time.
TEST(RainKeys, TheRateIsThatOfAThinRain) {
    const FilmedScene scene = read_text(with(wedge_text, "[run]", "[start]\nmethod = \"rain\"\n[run]"));
    const double deep = 4 * 0.01, time = std::sqrt(2 * deep / 10);
    const double area = scene.container.volume() / 0.18;
    const double grain = std::numbers::pi / 6 * (100 * std::pow(0.005, 3) + 10 * std::pow(0.01, 3)) / 110;
    EXPECT_NEAR(rain_rate(scene), 0.05 * deep / time * area / grain, 1e-9 * rain_rate(scene));
}

std::string complaint(const std::string& text) {
    try {
        make_plan(read_text(text));
    } catch (const UserError& error) {
        return error.what();
    }
    return "none";
}

TEST(FeedKeys, Complain) {
    EXPECT_THAT(complaint(fed("species = \"nut\"\nrate = 1\n")),
                tells_only({"test.toml:29:1", "'species'", "\"nut\"", "no species", "[[species]]"}));
    EXPECT_THAT(complaint(fed("from = 1\n")),
                tells_only({"test.toml:28:1", "[[feed]]", "'rate'", "rate = \"10 1/s\""}));
    EXPECT_THAT(complaint(fed("count = 5\n")),
                tells_only({"test.toml:29:1", "'count'", "how fast", "'rate', or 'until'"}));
    EXPECT_THAT(complaint(fed("rate = 1\nfrom = 1\nuntil = 1\n")),
                tells_only({"test.toml:31:1", "'until'", "1 s", "'from', 1 s", "raise"}));
    EXPECT_THAT(complaint(fed("rate = 1\nfrom = 2\n")),
                tells_only({"test.toml:30:1", "'from'", "2 s", "ends at 2 s", "run.duration"}));
    EXPECT_THAT(complaint(fed("rate = 1\nlow = [0, 0, 0.1]\n")),
                tells_only({"test.toml:28:1", "[[feed]]", "'high'", "high = [\"5 mm\", 0, 0]"}));
    EXPECT_THAT(complaint(fed("rate = 1\nlow = [0, 0, 0.1]\nhigh = [0, 0, 0.05]\n")),
                tells_only({"test.toml:30:1", "'low'", "beyond 'high'", "exchange"}));
    EXPECT_THAT(complaint(fed("rate = 1\nlow = [0, 0.06, 0.1]\nhigh = [0, 0.07, 0.15]\n")),
                tells_only({"test.toml:28:1", "'feed[0]'", "no place", "0.005 m", "'low' and 'high'"}));
    EXPECT_THAT(complaint(fed("rate = 10000\n")), tells_only({"test.toml:28:3", "20110 grains", "162.9 %",
                                                              "0.0008107 m3", "64 %", "feed fewer"}));
    EXPECT_EQ(complaint(fed("rate = 1e15\n")).substr(0, 26), "test.toml:3:3: 4000000110 ");
}

TEST(RainKeys, Complain) {
    const std::string rain = with(wedge_text, "[run]", "[start]\nmethod = \"rain\"\n[run]");
    EXPECT_THAT(complaint(with(rain, "gravity = 10.0", "gravity = [0, 0, 10]")),
                tells_only({"test.toml:27:1", "'method'", "\"rain\"", "gravity", "\"layers\""}));
    EXPECT_THAT(complaint(with(wedge_text, "[run]", "[start]\nrain_rate = 5\n[run]")),
                tells_only({"test.toml:27:1", "'rain_rate'", "of no use", "rain", "remove"}));
}

}  // namespace
}  // namespace grainreel
