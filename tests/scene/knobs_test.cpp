// Tests of [[knob]] and [play], and of the bed whose knobs are turned while it moves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.hpp"
#include "engine/measure/columns.hpp"
#include "engine/plan/plan.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/play/knobs.hpp"
#include "engine/play/played_bed.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

Scene scene_with(const std::string& more) {
    return read_scene_text(test::small_scene_text + more, "fifty.toml", {"run.duration=10 s"}, measurable_in);
}

std::string complaint(const std::string& more) {
    try {
        knobs_of(scene_with(more));
    } catch (const UserError& error) {
        return error.what();
    }
    return "none";
}

TEST(Knobs, AreThoseOfTheSceneWithItsRanges) {
    const Scene scene = scene_with(
        "[play]\nchallenge = \"Up\"\n[[knob]]\nkey = \"drive.frequency\"\n"
        "range = [\"10 Hz\", \"0.04 kHz\"]\nlabel = \"how fast\"\n");
    const std::vector<Knob> knobs = knobs_of(scene);
    ASSERT_EQ(knobs.size(), 1u);
    EXPECT_EQ(knobs[0].low, 10);
    EXPECT_EQ(knobs[0].high, 40);
    EXPECT_EQ(knobs[0].label, "how fast");
    EXPECT_EQ(scene.challenge, "Up");
    const Scene again = read_scene_text(written_scene(scene), "fifty.toml", {}, measurable_in);
    EXPECT_EQ(again.knobs, scene.knobs);
    EXPECT_EQ(again.challenge, "Up");
}

TEST(Knobs, ThatCannotBeTurnedAreRefused) {
    EXPECT_THAT(complaint("[[knob]]\nkey = \"drive.speed\"\n"),
                test::tells({"key", "drive.speed", "no knob"}));
    EXPECT_THAT(complaint("[[knob]]\nkey = \"species.sand.count\"\n"),
                test::tells({"species.sand.count", "cannot", "drive.g_level"}));
    EXPECT_THAT(complaint("[[knob]]\nkey = \"drive.frequency\"\nrange = [\"30 Hz\", \"10 Hz\"]\n"),
                test::tells({"range", "smaller"}));
    EXPECT_THAT(complaint("[[knob]]\nkey = \"drive.frequency\"\nrange = [\"1 Hz\", \"2 Hz\"]\n"),
                test::tells({"range", "drive.frequency", "widen"}));
    EXPECT_THAT(complaint("[[knob]]\nkey = \"drive.frequency\"\nrange = [\"1 mm\", \"2 mm\"]\n"),
                test::tells({"range", "frequency", "length"}));
}

TEST(Knobs, ChangeWhatTheyNameAndKeepTheRest) {
    Scene scene = scene_with("");
    const double acceleration = scene.drive.g_level(scene.gravity.norm());
    for (const Knob& knob : possible_knobs(scene)) {
        const double wanted = knob.whole ? std::floor(knob.high) : 0.5 * (knob.low + knob.high);
        turn_knob(scene, knob.key, wanted);
        EXPECT_NEAR(knob_value(scene, knob.key), wanted, 1e-12 * wanted) << knob.key;
    }
    turn_knob(scene, "gravity", 9.81);
    turn_knob(scene, "drive.g_level", acceleration);
    turn_knob(scene, "drive.frequency", 7);
    EXPECT_NEAR(scene.drive.g_level(9.81), acceleration, 1e-12);
}

// Two beds of one scene, played and simulated.
struct Beds {
    Scene scene = scene_with("");
    Plan plan = make_plan(scene);
    PlayedBed played{resolved_scene(scene, plan), written_scene(scene), {}};
};

TEST(PlayedBed, HasTheBitsOfARunUntilAKnobIsTurned) {
    Beds beds;
    SimulatedBed run(beds.scene, beds.plan, 1);
    run.pack();
    beds.played.pack([](const PackingProgress&) { return true; });
    for (const std::int64_t step : {1, 40, 500}) {
        run.advance(step);
        beds.played.advance(step - beds.played.bed().step());
        EXPECT_EQ(run.state_hash(), beds.played.bed().state_hash()) << step;
    }
    beds.played.turn("contact.friction", 0.01);
    run.advance(1000);
    beds.played.advance(500);
    EXPECT_NE(run.state_hash(), beds.played.bed().state_hash());
}

TEST(PlayedBed, ChangesItsDriveAsSoonAsItCan) {
    Beds beds;
    beds.played.pack([](const PackingProgress&) { return true; });
    const double f = beds.scene.drive.frequency, step = beds.plan.clock.step;
    const auto run_for = [&](double seconds) {
        for (int part = 0; part < 50; ++part) beds.played.advance(std::llround(seconds / 50 / step));
    };
    run_for(0.5 / f);
    beds.played.turn("drive.frequency", 2 * f);  // the drive still grows, so this waits
    beds.played.advance(1);
    EXPECT_EQ(beds.played.bed().measure("drive_frequency_Hz"), f);
    run_for(8 / f);
    EXPECT_NEAR(beds.played.bed().measure("drive_frequency_Hz"), 2 * f, 1e-9 * f);
    EXPECT_NEAR(beds.played.bed().measure("drive_g_level"), beds.scene.drive.g_level(9.81), 1e-6);
    beds.played.shake(PlayedBed::Shaking::taps_once);
    double top = 0;
    int rises = 0;
    for (int part = 0; part < 400; ++part) {
        beds.played.advance(std::llround(0.02 / f / step));
        const double place = beds.played.bed().measure("floor_position_m");
        if (part > 200 && place > 1e-6 && top <= 1e-6) ++rises;
        top = place;
    }
    EXPECT_LE(rises, 1);
    EXPECT_NEAR(beds.played.bed().measure("floor_position_m"), 0, 1e-12);  // it rests
    EXPECT_EQ(beds.played.bed().measure("drive_g_level"), 0);
}

TEST(PlayedBed, GivesTheSceneWithItsKnobs) {
    Beds beds;
    beds.played.pack([](const PackingProgress&) { return true; });
    beds.played.advance(10);
    beds.played.turn("gravity", 1.62);
    beds.played.tilt(0.1);
    beds.played.turn("drive.frequency", 12);
    const Scene taken = read_scene_text(beds.played.scene_text(), "taken.toml", {}, measurable_in);
    EXPECT_NEAR(taken.gravity.norm(), 1.62, 1e-12);
    EXPECT_NEAR(taken.gravity.y(), 1.62 * std::sin(0.1), 1e-12);
    EXPECT_EQ(taken.drive.frequency, 12);
    EXPECT_TRUE(taken.drive.stages.empty());
    make_plan(taken);
}

TEST(PlayedBed, PacksAnewWithTurnedKnobs) {
    const Scene scene = scene_with("");
    const std::string key = "species." + scene.species[0].name + ".count";
    PlayedBed bed(resolved_scene(scene, make_plan(scene)), written_scene(scene), {{key, 7}, {"run.seed", 5}});
    EXPECT_EQ(bed.scene().species[0].count, 7);
    EXPECT_EQ(bed.scene().run.seed, 5u);
    EXPECT_TRUE(bed.scene().run.step.has_value());
}

}  // namespace
}  // namespace grainreel
