// Tests of the words that a film has: which there are, what they say, and that words that are left out leave
// no hole.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "render/picture/base/shot.hpp"
#include "render/picture/container/container_drawing.hpp"
#include "render/picture/container/drawing_kit.hpp"
#include "render/picture/panels/side_by_side.hpp"
#include "render/picture/words/blocks.hpp"
#include "render/picture/words/captions.hpp"
#include "render/picture/words/missing_letters.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

constexpr bool WordKinds::*every_kind[] = {&WordKinds::title,    &WordKinds::legend,   &WordKinds::time,
                                           &WordKinds::cycle,    &WordKinds::dial,     &WordKinds::drive,
                                           &WordKinds::playback, &WordKinds::scale,    &WordKinds::arrows,
                                           &WordKinds::counts,   &WordKinds::captions, &WordKinds::shaking};

WordKinds none() {
    WordKinds kinds;
    for (const auto kind : every_kind) kinds.*kind = false;
    return kinds;
}

FilmedScene with_all_words(int width, int height) {
    FilmedScene scene = wedge(width, height);
    scene.container.outlet = Outlet{Outlet::Shape::slot, 0.02, 0, 0.05};
    scene.film.shows.outflow = true;
    scene.film.captions = {{0, 5, "Words that stand there for a while", 0}};
    for (const auto kind : every_kind) scene.film.word_kinds.*kind = true;
    return scene;
}

Shot flowing() {
    Shot frame = frame_of({{Vec3(0, 0, 0.02)}});
    frame.time = 1.25;
    frame.cycles = 25.25;
    frame.phase = 0.25;
    frame.flowed_out = {12, 0.003};
    return frame;
}

std::vector<std::string> names_of(const FilmedScene& scene) {
    const Palette palette = make_palette(scene.film.background);
    const PictureLayout layout = plan_layout(scene);
    const Writer measure{nullptr, layout.type, palette};
    std::vector<std::string> names;
    for (const FirstPart::Block& block :
         first_part(measure, scene, nullptr, layout, layout.first.width).blocks)
        names.push_back(block.name);
    return names;
}

int area(const Rectangle& r) {
    return r.width * r.height;
}

TEST(WordsShown, WithoutAnyTheGrainsHaveThePicture) {
    for (const auto& [width, height] : {std::pair{640, 360}, {360, 640}}) {
        FilmedScene scene = with_all_words(width, height);
        scene.film.word_kinds = none();
        const PictureLayout layout = plan_layout(scene);
        EXPECT_EQ(area(layout.port), width * height);
        EXPECT_EQ(area(layout.first), 0);
        EXPECT_EQ(area(layout.second), 0);
        EXPECT_TRUE(layout.left_out.empty());
        Renderer worded(scene, 1, gl::Provider::automatic);
        Renderer bare(scene, bare_layout(scene.film), 1, gl::Provider::automatic);
        EXPECT_EQ(worded.draw(flowing(), "as it is").rgba, bare.draw(flowing(), "as it is").rgba);
    }
}

// Each kind of words can stand alone, and takes less room than all of them.
TEST(WordsShown, EachKindStandsAlone) {
    for (const auto& [width, height] : {std::pair{640, 360}, {360, 640}})
        for (const auto kind : every_kind) {
            FilmedScene scene = with_all_words(width, height);
            const int all = area(plan_layout(scene).port);
            scene.film.word_kinds = none();
            Renderer without(scene, 1, gl::Provider::automatic);
            const std::vector<std::uint8_t> nothing = without.draw(flowing(), "as it is").rgba;
            scene.film.word_kinds.*kind = true;
            Renderer with(scene, 1, gl::Provider::automatic);
            const bool upright = width < height;
            // Upright pictures have arrows if these have to do with the drive.
            EXPECT_NE(with.draw(flowing(), "as it is").rgba, nothing) << upright;
            EXPECT_GE(area(plan_layout(scene).port), all);
        }
}

// The marks beside the floor are explained among the arrows, and are left out together with them.
TEST(WordsShown, MarksBesideTheFloorGoWithTheArrows) {
    FilmedScene scene = wedge();
    scene.film.word_kinds.arrows = true;
    EXPECT_EQ(lab_marks(scene, scene.film.camera.azimuth).size(), 2u);
    scene.film.word_kinds.arrows = false;
    EXPECT_TRUE(lab_marks(scene, scene.film.camera.azimuth).empty());
}

// The film says the time and its pace, what shakes, and the scale. Other signs are there if they are asked
// for.
TEST(WordsShown, ThreeSignsStandThereByDefault) {
    const FilmedScene scene = wedge(1280, 720);
    const WordKinds& kinds = scene.film.word_kinds;
    EXPECT_TRUE(kinds.time && kinds.shaking && kinds.scale && kinds.legend && kinds.playback);
    EXPECT_FALSE(kinds.cycle || kinds.dial || kinds.drive || kinds.arrows);
    EXPECT_EQ(clock_words(scene, flowing()), "t = 1.250 s");
    EXPECT_EQ(shaking_text(scene, flowing()), "20 Hz, " + drive_lines(scene, flowing())[1]);
    EXPECT_EQ(shaking_text(scene, flowing(), {true, false}), "20 Hz");
    EXPECT_TRUE(lab_marks(scene, scene.film.camera.azimuth).empty());
}

TEST(WordsShown, WhatShakesFollowsTheDrive) {
    FilmedScene scene = wedge();
    scene.drive.stages = {{DriveStage::Kind::rest, 1, 3, 0, 0, 0}};
    EXPECT_EQ(shaking_text(scene, flowing()), "at rest");
    scene.film.wording.language = Language::de;
    EXPECT_EQ(shaking_text(scene, flowing()), "in Ruhe");
    const Palette palette = make_palette({1, 1, 1});
    const TypeScale type = type_scale(scene.film);
    const Writer measure{nullptr, type, palette};
    const double with = drive_block(measure, scene, nullptr, nullptr, 0, 0).height;
    scene.film.word_kinds.shaking = false;
    EXPECT_EQ(drive_block(measure, scene, nullptr, nullptr, 0, 0).height, 0);
    EXPECT_GT(with, 0);
}

// Digits of DejaVu Sans are 0.729 of their letters' size high.
TEST(WordsShown, DigitsAreElevenPixelsHighFrom480Lines) {
    for (const auto& [width, height] : {std::pair{854, 480}, {640, 640}, {720, 1280}, {1920, 1080}}) {
        const FilmedScene scene = wedge(width, height);
        for (const double shrink : {1.0, 0.8})
            EXPECT_GE(0.729 * type_scale(scene.film, shrink).minor, 10.999) << width << "x" << height;
    }
    EXPECT_EQ(type_scale(wedge(64, 64).film).minor, 10);
}

TEST(WordsShown, AColumnHasRoomForTheNumberInTheTray) {
    FilmedScene scene = wedge();
    scene.container.tray.emplace();
    scene.film.word_kinds.counts = true;
    set_species(scene, {});
    add_species(scene, {"sand", 99999999, 0.004, blue});
    const Palette palette = make_palette(scene.film.background);
    const TypeScale type = type_scale(scene.film, 1);
    const Writer measure{nullptr, type, palette};
    const double words = measure.write(0, 0, "99999999 of 99999999 in the tray", measure.minor(), {}).width;
    EXPECT_GE(plan_numbers(measure, scene, 1e9, 400, false).width, words);
}

TEST(WordsShown, ALegendThatIsTooWideBreaksItsLines) {
    FilmedScene scene = wedge();
    const Palette palette = make_palette(scene.film.background);
    const TypeScale type = type_scale(scene.film, 1);
    const Writer measure{nullptr, type, palette};
    const TextSize wide = legend_block(measure, scene, 0, 0, 0),
                   narrow = legend_block(measure, scene, 0, 0, 0.8 * wide.width);
    EXPECT_LE(narrow.width, 0.8 * wide.width);
    EXPECT_GT(narrow.height, wide.height);
}

TEST(WordsShown, AnEmptyTitleIsNone) {
    FilmedScene scene = wedge();
    EXPECT_THAT(names_of(scene), testing::Contains("title"));
    scene.film.title.clear();
    EXPECT_THAT(names_of(scene), testing::Not(testing::Contains("title")));
    EXPECT_EQ(shown_title(scene.film), "");
    const Palette palette = make_palette(scene.film.background);
    const PictureLayout layout = plan_layout(scene);
    const Writer measure{nullptr, layout.type, palette};
    // The legend moves up to where the title was.
    const FirstPart part = first_part(measure, scene, nullptr, layout, layout.first.width);
    EXPECT_EQ(part.blocks.front().box.y, layout.type.margin);
    scene.film.title = "A title";
    scene.film.word_kinds.title = false;
    EXPECT_THAT(names_of(scene), testing::Not(testing::Contains("title")));
    EXPECT_EQ(shown_title(scene.film), "");
}

TEST(WordsShown, TextsFollow) {
    FilmedScene scene = with_all_words(640, 360);
    const Shot frame = flowing();
    EXPECT_THAT(note_text(scene, frame), testing::HasSubstr("12 of 1620 out"));
    EXPECT_EQ(caption_at(scene.film, scene.run.duration, frame), "Words that stand there for a while");
    scene.film.word_kinds.counts = false;
    EXPECT_EQ(note_text(scene, frame), "");
    EXPECT_EQ(longest_note(scene), "");
    scene.film.word_kinds.captions = false;
    EXPECT_EQ(caption_at(scene.film, scene.run.duration, frame), "");
    EXPECT_EQ(clock_words(scene, frame), "t = 1.250 s\ncycle 25\nphase 0.25");
    scene.film.word_kinds.cycle = false;
    EXPECT_EQ(clock_words(scene, frame), "t = 1.250 s");
    scene.film.word_kinds.time = false;
    EXPECT_EQ(clock_words(scene, frame), "");
    EXPECT_EQ(playback_text(scene.film, frame, "slow"), "slow");
    scene.film.word_kinds.playback = false;
    EXPECT_EQ(playback_text(scene.film, frame, "slow"), "");
}

// While grains are still to come, nobody knows how many there will be in all.
TEST(WordsShown, OutflowOfFedGrainsNamesNoTotal) {
    FilmedScene scene = with_all_words(640, 360);
    scene.species[0].fed = 300;
    EXPECT_THAT(note_text(scene, flowing()), testing::StartsWith("12 out\n"));
}

TEST(WordsShown, PanelsFollow) {
    std::vector<Panel> panels{{wedge(), "left"}, {wedge(), "right"}};
    panels[1].scene.species[0].count = 700;
    Film film = panels[0].scene.film;
    film.title = "Together";
    const PanelLayout all = layout_of(panels, film);
    for (Panel& panel : panels) panel.scene.film.word_kinds = none();
    film.word_kinds = none();
    const PanelLayout bare = layout_of(panels, film);
    EXPECT_EQ(bare.bottom.height, 0);
    EXPECT_EQ(bare.places[0].caption.height, 0);
    EXPECT_EQ(bare.places[0].foot.height, 0);
    EXPECT_LT(bare.top.height, all.top.height);
    EXPECT_GT(area(bare.places[0].port), area(all.places[0].port));
}

// A legend is higher by a line if a feed gives more grains than there are at the start.
TEST(WordsShown, ALegendTellsFedGrainsFromThoseAtTheStart) {
    FilmedScene at_start = wedge(), fed = wedge(), both = wedge();
    fed.species[0].fed = fed.species[0].count;
    fed.species[0].count = 0;
    both.species[0].fed = 300;
    const Palette palette = make_palette(at_start.film.background);
    const TypeScale type = type_scale(at_start.film);
    const Writer measure{nullptr, type, palette};
    const auto size = [&](const FilmedScene& scene) { return legend_block(measure, scene, 0, 0, 0); };
    EXPECT_NE(size(at_start).width, size(fed).width);
    EXPECT_EQ(size(at_start).height, size(fed).height);
    EXPECT_NEAR(size(both).height - size(fed).height, measure.write(0, 0, "0", measure.minor(), {}).height,
                0.5);
}

TEST(WordsShown, ForcesOnWallsAndBetweenGrainsHaveUnlikeColours) {
    for (const Colour& background : {Colour{1, 1, 1}, Colour{0.07, 0.08, 0.1}}) {
        const Palette palette = make_palette(background);
        const std::vector<Colour> colours{palette.force, palette.wall_force, palette.accent, palette.ink};
        for (const Colour& a : colours) {
            EXPECT_GT(contrast(a, background), 4.5);
            for (const Colour& b : colours)
                if (&a != &b) {
                    const double apart =
                        std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue);
                    EXPECT_GT(apart, 0.4);
                }
        }
    }
}

// A speed cannot be less than 0 but may always be larger; a velocity has both signs.
TEST(WordsShown, ABarHasTipsWhereThereMayBeMore) {
    const TypeScale type = type_scale(wedge().film);
    const auto place = [&](GrainValue by, double low) {
        return colour_bar_place(ColourScale({by, ColourMap::viridis, {low, 1}, false, "", 5}), type, 0, 0,
                                200);
    };
    const ColourBarPlace speed = place(GrainValue::speed, 0);
    EXPECT_EQ(speed.tip_below, 0);
    EXPECT_GT(speed.tip_above, 0);
    EXPECT_EQ(speed.width + speed.tip_above, 200);
    EXPECT_GT(place(GrainValue::speed, 0.1).tip_below, 0);
    const ColourBarPlace upward = place(GrainValue::vertical_velocity, 0);
    EXPECT_GT(upward.tip_below, 0);
    EXPECT_EQ(upward.x, upward.tip_below);
}

TEST(WordsShown, ClippedGrainsAreCounted) {
    GrainColouring speed{GrainValue::speed, ColourMap::viridis, {0, 0.5}, false, "cm/s", 5};
    ClippedCount count;
    for (const double value : {0.0, 0.5, 0.6, 0.2, std::nan("")}) count.take(value, speed.range);
    EXPECT_EQ(count.all, 4);
    EXPECT_EQ(
        clipped_words(speed, count, "grains"),
        "colours by speed: 25 % of the grains lie above 50 cm/s, where the bar ends (film.colour.range)");
    EXPECT_EQ(clipped_words(speed, {4, 0, 0}, "grains"), "");
}

// A letter for private use is in no font.
TEST(WordsShown, LettersWithoutAFontAreNamed) {
    const std::string nowhere = "\xf3\xb0\x80\x81";  // U+F0001
    EXPECT_TRUE(missing_letters("Big and small, Γ = 3, µm").empty());
    EXPECT_EQ(missing_letters_warning({{"a.toml:1:1", "plain"}}), "");
    const std::string one =
        missing_letters_warning({{"a.toml:1:1", "plain"}, {"a.toml:2:8", "x" + nowhere + nowhere}});
    if (!missing_letters(nowhere).empty()) {
        EXPECT_THAT(one, testing::StartsWith("a.toml:2:8: no font here has " + nowhere + " ("));
        EXPECT_THAT(one, testing::HasSubstr("apt-get install fonts-noto"));
    }
    const std::vector<MissingLetters> chinese = missing_letters("振动");
    if (!chinese.empty()) {
        EXPECT_EQ(chinese.size(), 1u);
        EXPECT_EQ(chinese[0].letters, "振动");
        EXPECT_EQ(chinese[0].script, "Chinese");
        EXPECT_EQ(chinese[0].package, "fonts-noto-cjk");
    }
    FilmedScene scene = wedge();
    scene.species[0].name = nowhere;
    EXPECT_EQ(texts_of_film(scene).size(), 3u);  // title and two species
    scene.film.word_kinds.legend = false;
    EXPECT_EQ(texts_of_film(scene).size(), 1u);
    scene.film.words = WordPlace::none;
    EXPECT_TRUE(texts_of_film(scene).empty());
}

// Grains look the same down to the floor, and are gone where they leave.
TEST(WordsShown, GrainsFadeBeforeTheyLeave) {
    FilmedScene scene = wedge(640, 360);
    const View view = view_of(scene);
    EXPECT_TRUE(exit_fade(scene, view, 360).empty());
    scene.container.outlet = Outlet{Outlet::Shape::slot, 0.02, 0, 0.08};
    const View open = view_of(scene);
    const std::vector<std::uint32_t> rows = exit_fade(scene, open, 360);
    ASSERT_EQ(rows.size(), 360u);
    const auto row_of = [&](double z) { return static_cast<std::size_t>(open.project(Vec3(0, 0, z)).y()); };
    EXPECT_EQ(rows[row_of(0)], 255u);
    EXPECT_EQ(rows[row_of(-0.039)], 255u);
    EXPECT_NEAR(static_cast<double>(rows[row_of(-0.06)]), 128, 20);
    EXPECT_LT(rows[row_of(-0.08)], 8u);
    EXPECT_TRUE(std::is_sorted(rows.rbegin(), rows.rend()));
    scene.container.tray = Tray{};
    EXPECT_TRUE(exit_fade(scene, open, 360).empty());
}

// Grains begin to fade half way down to the exit, or below the lowest place at which the floor's plate is
// drawn. Seen level and without perspective, a row of pixels is a height.
TEST(WordsShown, GrainsFadeBelowTheFloorAsItIsDrawn) {
    for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(0, 0.6, 0.8), Vec3(0, 1, 0)}) {
        FilmedScene scene = wedge(640, 360);
        scene.container.outlet = Outlet{Outlet::Shape::slot, 0.02, 0, 0.08};
        scene.film.camera.azimuth = scene.film.camera.elevation = scene.film.camera.field_of_view = 0;
        scene.drive.direction = direction;
        scene.drive.amplitude = 0.004;
        scene.film.exaggerate = 10;
        const View view = view_of(scene);
        const auto row_of = [&](double z) { return view.project(Vec3(0, 0, z)).y(); };
        const double floor =
            -1.4 * drawn_thickness(scene.container) - 0.04 * std::abs(scene.drive.direction.z());
        const double begin = std::max(row_of(-0.04), row_of(floor)), end = row_of(-0.08);
        ASSERT_GT(end - begin, 8);
        const std::vector<std::uint32_t> rows = exit_fade(scene, view, 360);
        ASSERT_EQ(rows.size(), 360u);
        for (int y = 0; y < 360; ++y)
            ASSERT_NEAR(rows[static_cast<std::size_t>(y)],
                        255 * std::clamp((end - y - 0.5) / (end - begin), 0.0, 1.0), 1)
                << "row " << y << " along " << direction.transpose();
    }
}

}  // namespace
}  // namespace grainreel::test
