// Tests of what a scene says about colours and marks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/base/error.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/text/units.hpp"
#include "render/scene/shown_values.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;

GrainColouring colour_of(const std::vector<std::string>& set) {
    return read_text(wedge_text, set).film.shows.colour;
}

void expect_complaint(const std::vector<std::string>& set, const std::string& words) {
    try {
        read_text(wedge_text, set);
        FAIL() << "accepted";
    } catch (const UserError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr(words));
    }
}

TEST(Look, UsualRangesComeFromTheDrive) {
    const FilmedScene scene = read_text(wedge_text);
    const double omega = 2 * std::numbers::pi * 20, plate = 3 * 10.0 / omega;  // a w = Gamma g / w
    // A blow comes back from n layers with e to the power of 2 n - 1 of its speed (the film's v, colours.md).
    double restitution = 0;
    for (const PairContact& pair : scene.contact.grain) restitution = std::max(restitution, pair.restitution);
    for (const PairContact& pair : scene.contact.wall) restitution = std::max(restitution, pair.restitution);
    const double layers = std::max(1.0, fill_height(scene, 0.5) / mean_diameter(scene));
    const double back = std::min(0.98, std::pow(restitution, 2 * layers - 1));
    const double speed = plate * (1.8 + 0.75 * (std::sqrt((1 + back) / (2 * (1 - back))) - std::sqrt(0.5)));
    EXPECT_GE(speed, 1.8 * plate);
    EXPECT_NEAR(colour_of({"film.colour.by=speed"}).range[1], speed, 1e-12);
    const GrainColouring upward = colour_of({"film.colour.by=vertical-velocity"});
    EXPECT_EQ(upward.map, ColourMap::vik);
    EXPECT_NEAR(upward.range[0], -speed, 1e-12);
    EXPECT_NEAR(upward.range[1], speed, 1e-12);
    // The range is four amplitudes, or a diameter if that is more.
    EXPECT_NEAR(colour_of({"film.colour.by=displacement"}).range[1], std::max(0.005, 4 * plate / omega),
                1e-12);
    EXPECT_NEAR(colour_of({"film.colour.by=displacement", "drive.g_level=0.01"}).range[1], 0.005, 1e-12);
}

TEST(Look, AllWallsMayBeGlass) {
    const FilmedScene clear = read_text(wedge_text, {"film.walls.glass=true"});
    EXPECT_TRUE(clear.film.look.walls.clear);
    EXPECT_TRUE(
        read_filmed_scene_text(resolved_scene(clear, make_plan(clear)), "scene.toml").film.look.walls.clear);
    EXPECT_FALSE(read_text(wedge_text, {"film.walls.glass=false"}).film.look.walls.clear);
    expect_complaint({"film.walls.glass=[\"none\"]"}, "names the mesh \"none\"");
}

// A few lively layers are thrown faster than a deep bed, and grains that leave fall faster than they are
// thrown.
TEST(Look, UsualSpeedsFollowTheBed) {
    const auto speed = [](const std::vector<std::string>& set) {
        std::vector<std::string> all{"film.colour.by=speed"};
        all.insert(all.end(), set.begin(), set.end());
        return colour_of(all).range[1];
    };
    EXPECT_GT(speed({"contact.restitution=0.99"}), speed({"contact.restitution=0.5"}));
    const double plate = 3 * 10.0 / (2 * std::numbers::pi * 20);
    EXPECT_NEAR(speed({"contact.restitution=0.01"}), 1.8 * plate, 0.01 * plate);
    const std::vector<std::string> outlet{"container.outlet.width=20 mm", "container.outlet.exit_depth=1 m"};
    EXPECT_NEAR(speed(outlet), std::sqrt(2 * 10.0 * 1), 1e-9);
}

// If 1 grain in 100 is faster than v, the share exp(-ln 100 E / (m v2 / 2)) of the grains with the mass m has
// an energy above E.
TEST(Look, UsualEnergiesHoldNinetyNineOfAHundred) {
    const FilmedScene scene = read_text(wedge_text, {"film.colour.by=kinetic-energy"});
    const double energy = scene.film.shows.colour.range[1];
    const double speed = colour_of({"film.colour.by=speed"}).range[1];
    double above = 0;
    for (const Species& one : scene.species) {
        const double mass = one.density * std::numbers::pi / 6 * mean_cube(one.diameter);
        above += static_cast<double>(one.all()) / static_cast<double>(scene.grains()) *
                 std::exp(-std::log(100.0) * energy / (0.5 * mass * speed * speed));
    }
    EXPECT_NEAR(above, 0.01, 1e-6);
}

TEST(Look, ShowNamesTheWords) {
    EXPECT_EQ(read_text(wedge_text).film.word_kinds, WordKinds());
    const WordKinds some = read_text(wedge_text, {"film.show=[\"title\", \"scale\"]"}).film.word_kinds;
    EXPECT_TRUE(some.title && some.scale);
    EXPECT_FALSE(some.legend || some.time || some.cycle || some.dial || some.drive || some.playback ||
                 some.arrows || some.counts || some.captions);
    const FilmedScene nothing = read_text(wedge_text, {"film.show=[]"});
    EXPECT_FALSE(nothing.film.word_kinds.title);
    EXPECT_EQ(read_text(resolved_scene(nothing, make_plan(nothing))).film.word_kinds,
              nothing.film.word_kinds);
    expect_complaint({"film.show=[\"titel\"]"},
                     "--set film.show: 'show' has \"titel\", which is none of the words: title, legend, "
                     "time, cycle, dial, drive, shaking, playback, scale, arrows, counts, captions");
    expect_complaint({"film.show=title"}, "must be a list of names, but is \"title\"");
    try {
        read_text(wedge_text + "\n[film]\nshow = [\"time\", \"clock\"]\n");
        FAIL() << "accepted";
    } catch (const UserError& error) {
        const long line = std::count(wedge_text.begin(), wedge_text.end(), '\n') + 3;
        EXPECT_THAT(error.what(),
                    testing::HasSubstr(":" + std::to_string(line) + ":17: 'show' has \"clock\""));
    }
}

TEST(Look, ATitleMayBeEmpty) {
    EXPECT_EQ(read_text(wedge_text, {"title=A bed"}).film.title, "A bed");
    const FilmedScene without = read_text(wedge_text, {"title=A bed", "film.title="});
    EXPECT_EQ(without.film.title, "");
    EXPECT_EQ(read_text(resolved_scene(without, make_plan(without))).film.title, "");
}

TEST(Look, TextsAreNotEndless) {
    std::string long_enough;
    for (std::size_t k = 0; k < kMostLetters; ++k) long_enough += "Γ";
    EXPECT_EQ(read_text(wedge_text, {"film.title=" + long_enough}).film.title, long_enough);
    for (const char* key : {"film.title", "title", "species.big.name", "film.text"})
        expect_complaint({std::string(key) + "=" + long_enough + "x"},
                         "has 1001 characters, and the most are 1000; shorten it");
}

TEST(Look, AConditionIsAQuantityAndALimit) {
    const GrainCondition fast =
        read_text(wedge_text, {"film.highlight_if=\"speed > 20 cm/s\""}).film.shows.highlight_if;
    EXPECT_EQ(fast.of, GrainValue::speed);
    EXPECT_TRUE(fast.above);
    EXPECT_EQ(fast.limit, 0.2);
    const FilmShows loose = read_text(wedge_text, {"film.highlight_if=\"coordination<2\""}).film.shows;
    EXPECT_FALSE(loose.highlight_if.above);
    EXPECT_EQ(loose.highlight_if.limit, 2);
    EXPECT_TRUE(needs_touches(loose));
}

TEST(Look, RangesAndUnitsAreQuantities) {
    const GrainColouring colour =
        colour_of({"film.colour.by=speed", "film.colour.range=[0, \"20 cm/s\"]", "film.colour.unit=cm/s"});
    EXPECT_EQ(colour.range, (std::array<double, 2>{0, 0.2}));
    EXPECT_EQ(colour.unit, "cm/s");
    EXPECT_EQ(unit_size("cm/s", Dimension::speed), 0.01);
    EXPECT_EQ(fitting_unit(0.3, Dimension::speed), "mm/s");
    EXPECT_EQ(fitting_unit(0.5, Dimension::speed), "m/s");
    EXPECT_EQ(fitting_unit(2e-6, Dimension::energy), "µJ");
}

TEST(Look, MistakesAreSaid) {
    expect_complaint({"film.colour.by=speed", "film.colour.range=[1, 0]"}, "'range' must rise");
    expect_complaint({"film.colour.by=speed", "film.colour.range=[\"1 mm\", \"2 mm\"]"}, "is a length");
    expect_complaint({"film.colour.by=speed", "film.colour.range=5"}, "[low, high]");
    expect_complaint({"film.colour.by=speed", "film.colour.unit=kg"}, "'unit' must be a speed");
    expect_complaint({"film.colour.range=[0, 1]"}, "coloured by species");
    expect_complaint({"film.colour.by=spin", "film.colour.layers=4"}, "only 'by = \"start-height\"'");
    expect_complaint({"film.colour.by=coordination", "film.colour.unit=m"}, "pure number");
    expect_complaint({"film.hide=[\"large\"]"}, "\"large\", which is not there; there is \"small\", \"big\"");
    expect_complaint({"film.hide=\"big\""}, "must be a list of names");
    expect_complaint({"film.ghost=[\"big\"]", "film.hide=[\"small\", \"big\"]"},
                     "'ghost' names \"big\", which film.hide takes away; keep one of them");
    expect_complaint({"film.highlight_if=\"fast > 1\""}, "must be a quantity of film.colour.by, < or >");
    expect_complaint({"film.highlight_if=\"speed = 1\""}, "must be a quantity of film.colour.by, < or >");
    expect_complaint({"film.highlight_if=\"> 1\""}, "must be a quantity of film.colour.by, < or >");
    expect_complaint({"film.highlight_if=\"speed > 1 kg\""}, "must be a speed");
    expect_complaint({"film.highlight_if=\"coordination > two\""}, "wants a plain number");
    expect_complaint({"film.segment=[{exposures=4}]"}, "they are moments of an 'exposure'");
    expect_complaint({"film.segment=[{average=2, exposure=\"1 s\"}]"}, "a mean over periods has no shutter");
    expect_complaint({"film.segment=[{average=0}]"}, "from 1 to 1000");
    expect_complaint({"film.highlight=[110]"}, "ids run from 0 to 109");
    expect_complaint({"film.highlight=[-1]"}, "whole numbers");
}

TEST(Look, PlotsAreColumnsOfMeasures) {
    const std::string text =
        wedge_text + "[[film.plot]]\ny = \"kinetic\"\n[[film.plot]]\ny = \"big_height_m\"\n";
    const std::vector<FilmPlot> plots = read_text(text).film.shows.plots;
    ASSERT_EQ(plots.size(), 2u);
    EXPECT_EQ(plots[0].column, "kinetic_J");
    EXPECT_EQ(plots[0].label, "kinetic energy");
    EXPECT_EQ(plots[1].label, "mean height of big");
    const auto complaint = [&](const std::string& more) -> std::string {
        try {
            read_text(text + more);
        } catch (const UserError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_THAT(complaint("[[film.plot]]\ny = \"time_s\"\n"),
                tells({"test.toml:33:1", "'y'", "column", "measures.csv"}));
    EXPECT_THAT(complaint("[[film.plot]]\ny = \"lacey\"\nrange = [1, 0]\n"), testing::HasSubstr("must rise"));
    EXPECT_THAT(complaint("[[film.plot]]\ny = \"lacey\"\n[[film.plot]]\ny = \"lost\"\n"),
                testing::HasSubstr("only 3 fit"));
    EXPECT_THAT(complaint("[film.arrows]\nspeed = 1\n"), testing::HasSubstr("lacks 'grid'"));
    EXPECT_THAT(complaint("[film.trails]\nduration = 1\n"), testing::HasSubstr("need 'species' or 'grains'"));
}

TEST(Look, ProfilesStandInPlaceOfColumns) {
    const auto plots = [](const std::string& more) { return read_text(wedge_text + more).film.shows.plots; };
    const FilmPlot share = plots("[[film.plot]]\nprofile = \"share\"\n").at(0);
    EXPECT_EQ(share.profile, ProfileOf::share);
    EXPECT_FALSE(share.across);
    EXPECT_EQ(share.label, "share of the solid volume");
    const FilmPlot flow = plots("[[film.plot]]\nprofile = \"vertical-velocity\"\nover = \"width\"\n").at(0);
    EXPECT_TRUE(flow.across);
    EXPECT_TRUE(flow.period);
    EXPECT_EQ(flow.dimension, Dimension::speed);
    expect_complaint({"film.plot=[{profile=\"share\", y=\"lacey\"}]"}, "a plot with a 'profile' shows that");
    expect_complaint({"film.plot=[{over=\"width\", y=\"lacey\"}]"}, "there is no 'profile'");
    expect_complaint({"film.plot=[{profile=\"share\", of=\"now\"}]"}, "only profiles of velocities");
    expect_complaint({"film.plot=[{profile=\"speed\"}]"}, "solid-fraction");
    expect_complaint({"film.plot=[{}]"}, "lacks 'y'");
    expect_complaint({"film.plot=[{profile=\"share\", smooth=\"period\"}]"}, "a 'profile' is of one moment");
    expect_complaint({"film.plot=[{y=\"lacey\", smooth=\"day\"}]"}, "\"none\"");
    const FilmPlot rows = plots("[[film.plot]]\ny = \"lacey\"\n").at(0);
    const FilmPlot smooth = plots("[[film.plot]]\ny = \"lacey\"\nsmooth = \"period\"\n").at(0);
    EXPECT_TRUE(rows.period) << "with a drive, a plot is smooth";
    EXPECT_TRUE(smooth.period);
    EXPECT_FALSE(read_text(with(wedge_text, "\"2 s\"", "\"0.05 s\"") + "[[film.plot]]\ny = \"lacey\"\n")
                     .film.shows.plots.at(0)
                     .period)
        << "a run that is shorter than three periods has no mean over one";
    EXPECT_FALSE(plots("[[film.plot]]\ny = \"lacey\"\nsmooth = \"none\"\n").at(0).period);
    EXPECT_EQ(smooth.label, rows.label);
    EXPECT_EQ(plots("[[film.plot]]\ny = \"lacey\"\nsmooth = \"period\"\nlabel = \"L\"\n").at(0).label, "L");
}

TEST(Look, WhatAPlotShowsIsMeasured) {
    EXPECT_TRUE(read_text(wedge_text).instruments().empty());
    const FilmedScene scene = read_text(wedge_text + "[[film.plot]]\ny = \"floor_force_z\"\n");
    EXPECT_EQ(scene.instruments(), std::vector<std::string>{"walls"});
    EXPECT_TRUE(scene.output.instruments.empty());
}

TEST(Look, WallForcesAreMeasuredAndScaledByTheWeight) {
    const FilmedScene scene = read_text(wedge_text, {"film.wall_forces=true"});
    EXPECT_NEAR(scene.film.shows.wall_forces.scale,
                total_mass(scene) * scene.gravity.norm() * scene.drive.g_level(scene.gravity.norm()), 1e-12);
    EXPECT_THAT(scene.instruments(), testing::Contains("walls"));
    EXPECT_EQ(read_text(wedge_text, {"film.wall_forces=true", "film.wall_force_scale=\"3 N\""})
                  .film.shows.wall_forces.scale,
              3);
    expect_complaint({"film.wall_force_scale=3"}, "it belongs to wall_forces = true");
    expect_complaint({"film.outflow=true"}, "there is no [container.outlet] and no [[exit]]");
    expect_complaint({"film.streamlines.speed=1"}, "lacks 'grid'");
}

TEST(Look, ArrowsOfAPeriodScaleWithDiameterAndFrequency) {
    EXPECT_NEAR(read_text(wedge_text, {"film.arrows.grid=8"}).film.shows.arrows.speed, 0.2 * 0.005 * 20,
                1e-12);
    const FilmArrows now =
        read_text(wedge_text, {"film.arrows.grid=8", "film.arrows.of=now"}).film.shows.arrows;
    EXPECT_NEAR(now.speed, 3 * 10.0 / (2 * std::numbers::pi * 20), 1e-12);
}

TEST(Look, WithoutADriveOrScaleItIsSaid) {
    const auto complaint = [](const std::vector<std::string>& set) -> std::string {
        try {
            read_text(box_text, set);
        } catch (const UserError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_THAT(complaint({"film.colour.by=rise"}), testing::HasSubstr("nothing oscillates"));
    EXPECT_THAT(complaint({"film.plot=[{y=\"lacey\", smooth=\"period\"}]"}),
                tells({"nothing oscillates", "[drive]", "\"none\""}));
    EXPECT_THAT(complaint({"film.colour.by=speed"}), tells({"no scale", "'range'"}));
}

}  // namespace
}  // namespace grainreel
