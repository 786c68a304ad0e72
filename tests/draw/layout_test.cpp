// Tests of words and plots of many pictures: they do not overlap, and those without room are named.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "engine/measure/columns.hpp"
#include "render/picture/plots/plot.hpp"
#include "render/picture/words/blocks.hpp"
#include "render/picture/words/gutter_ways.hpp"
#include "render/picture/words/layout.hpp"
#include "render/scene/film_pace.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/seen_box.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

struct Content {
    std::size_t plots = 0, species = 2;
    bool colours = false, text = false;
};

FilmedScene scene_of(int width, int height, const Content& content) {
    FilmedScene scene = wedge(width, height);
    scene.film.camera.frame = FramingScope::reach;
    scene.film.title = "Big and small grains in a vibrated wedge hopper";
    set_species(scene, {});
    for (std::size_t k = 0; k < content.species; ++k)
        add_species(scene, {fmt::format("kind {}", k), 200, 0.004 + 0.0005 * static_cast<double>(k), blue});
    for (std::size_t k = 0; k < content.plots; ++k)
        scene.film.shows.plots.push_back({"lacey", "Lacey mixing index", std::nullopt});
    if (content.colours)
        scene.film.shows.colour = {GrainValue::displacement, ColourMap::viridis, {0, 0.3}, false, "cm", 5};
    if (content.text) {
        scene.film.shows.text = "mixing {lacey}";
        scene.film.shows.live_words = {{"mixing ", "lacey", "", 1}, {"", "", "", 1}};
        scene.film.captions = {{1, 2, "a few words that take more than one line", 0}};
        scene.drive.stages = {{DriveStage::Kind::taps, 1, 3, 50, 0.001, 0.25}};
    }
    return scene;
}

struct Named {
    std::string name;
    double left, top, right, bottom;
};
Named named(const std::string& name, const Rectangle& r) {
    return {name, 1.0 * r.x, 1.0 * r.y, 1.0 * r.x + r.width, 1.0 * r.y + r.height};
}

std::vector<Named> blocks_of(const FilmedScene& scene, const PictureLayout& layout) {
    const Palette palette = make_palette(scene.film.background);
    const Writer measure{nullptr, layout.type, palette};
    std::vector<Named> blocks{named("port", layout.port)};
    if (layout.caption.height > 0) blocks.push_back(named("captions", layout.caption));
    const auto add = [&](const std::string& name, const Rectangle& gutter, double x, double y, double width,
                         double height) {
        if (width > 0 && height > 0)
            blocks.push_back({name, gutter.x + x, gutter.y + y, gutter.x + x + width, gutter.y + y + height});
    };
    for (const FirstPart::Block& block :
         first_part(measure, scene, nullptr, layout, layout.first.width).blocks)
        add(block.name, layout.first, block.box.x, block.box.y, block.box.width, block.box.height);
    const NumbersPlan plan = plan_numbers(measure, scene, layout);
    const auto part = [&](const std::string& name, const Rectangle& r) {
        add(name, layout.second, r.x, r.y, r.width, r.height);
    };
    part("clock", plan.clock_part), part("caption", plan.caption_part), part("note", plan.note_part);
    if (plan.has_dial) part("dial", plan.dial_part);
    for (const Rectangle& plot : plan.plots) part("plot", plot);
    const TextSize drive = drive_block(measure, scene, nullptr, nullptr, 0, 0);
    if (scene.drive.changes())
        part("drive", plan.drive_part);
    else
        add("drive", layout.second, plan.drive.x, plan.drive.y, drive.width, drive.height);
    if (layout.stacked && plan.has_arrows) {
        const TextSize arrows = arrows_block(measure, scene, nullptr, 0, 0);
        add("arrows", layout.second, plan.arrows.x, plan.arrows.y, arrows.width, arrows.height);
    }
    return blocks;
}

TEST(Layout, NothingLiesOnAnythingElse) {
    constexpr double kHair = 1.01;  // pixels, allowance for rounding
    for (const auto& [width, height] :
         {std::pair{1280, 720}, {720, 1280}, {640, 360}, {480, 480}, {640, 640}, {1600, 400}})
        for (const std::size_t plots : {0u, 1u, 3u})
            for (const std::size_t kinds : {1u, 9u})
                for (const bool more : {false, true}) {
                    const FilmedScene scene = scene_of(width, height, {plots, kinds, more, more});
                    const PictureLayout layout = plan_layout(scene);
                    const std::vector<Named> blocks = blocks_of(scene, layout);
                    const std::string what = fmt::format("{}x{}, {} plots, {} species, more: {}", width,
                                                         height, plots, kinds, more);
                    for (std::size_t i = 0; i < blocks.size(); ++i) {
                        const Named& a = blocks[i];
                        EXPECT_TRUE(a.left >= 0 && a.top >= 0 && a.right <= width && a.bottom <= height)
                            << a.name << " leaves the picture, " << what;
                        for (std::size_t j = i + 1; j < blocks.size(); ++j) {
                            const Named& b = blocks[j];
                            const double across = std::min(a.right, b.right) - std::max(a.left, b.left),
                                         down = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
                            EXPECT_FALSE(across > kHair && down > kHair)
                                << a.name << " and " << b.name << ", " << what;
                        }
                    }
                }
}

// A tenth of the room is for the ticks and the title.
TEST(Layout, PlotsAreHighEnoughToBeRead) {
    for (const auto& [width, height] : {std::pair{1280, 720}, {720, 1280}, {640, 640}, {854, 480}}) {
        FilmedScene scene = scene_of(width, height, {1, 2});
        const PictureLayout layout = plan_layout(scene);
        const Palette palette = make_palette({1, 1, 1});
        const Writer measure{nullptr, layout.type, palette};
        const NumbersPlan plan = plan_numbers(measure, scene, layout);
        ASSERT_EQ(plan.plots.size(), 1u) << width << "x" << height;
        PlotRange frame = plot_frame(scene, scene.film.shows.plots[0]);
        frame.range = {0, 1};
        frame.width = plan.plots[0].width, frame.height = plan.plots[0].height;
        const Plot plot(frame, layout.type, palette);
        EXPECT_GE(plot.y_of(0) - plot.y_of(1), 0.125 * std::min(width, height) - 1) << width << "x" << height;
    }
}

TEST(Layout, AWideBoxStandsBetweenWordsAboveAndBelow) {
    FilmedScene scene = scene_of(1280, 720, {0, 2});
    scene.film.camera.azimuth = 0;
    scene.film.camera.frame = FramingScope::container;
    scene.container.shape = Container::Shape::box;
    scene.container.half_width = 0.03;
    EXPECT_FALSE(plan_layout(scene).stacked);
    scene.container.half_width = 0.2;
    scene.container.depth = 0.02;
    const PictureLayout layout = plan_layout(scene);
    EXPECT_TRUE(layout.stacked);
    EXPECT_EQ(layout.port.width, 1280);
}

// The vessel is large in pictures of all forms, words do not cut it off, and gutters, port and captions cover
// the picture. The bounds are a little below what is reached (tests/bench/framing.cpp prints all scenes).
TEST(Layout, TheVesselIsLargeInWideSquareAndUprightPictures) {
    const std::tuple<const char*, const char*, double> all[] = {
        {"wedge_segregation", "854x480", 0.38},
        {"wedge_segregation", "640x640", 0.27},
        {"wedge_segregation", "720x1280", 0.19},
        {"teaching_sorting", "640x640", 0.48},
        {"teaching_sorting", "720x1280", 0.3},
        {"teaching_gas_cooling", "640x640", 0.36},
        {"teaching_changing_drive", "720x1280", 0.3},
        {"gravel", "854x480", 0.65},  // gravel without its captions
        {"gravel", "640x640", 0.5},
        {"gravel", "720x1280", 0.43},
        {"poured_heap", "854x480", 0.48},
        {"teaching_friction_and_rolling", "854x480", 0.38},
        {"teaching_friction_and_rolling", "640x480", 0.36},
        {"convection_wedge", "854x480", 0.3},
    };
    for (const auto& [name, size, least] : all) {
        const std::string file = std::string(GRAINREEL_SOURCE "/scenes/") + name + ".toml";
        std::vector<std::string> settings = {std::string("film.size=") + size};
        if (std::string(name) == "gravel") settings.emplace_back("film.caption=[]");
        const FilmedScene scene = read_filmed_scene(file, settings, measurable_in);
        const PictureLayout layout = plan_layout(scene);
        const SeenBox box = seen_box(scene, layout);
        EXPECT_GE(box.area(), least) << name << ", " << size;
        EXPECT_FALSE(box.cut_by_words) << name << ", " << size;
        EXPECT_LT(box.below, 0.15) << name << ", " << size;
        EXPECT_TRUE(layout.left_out.empty()) << name << ", " << size << ": " << layout.left_out.front();
        int covered = 0;
        for (const Rectangle& part : {layout.first, layout.second, layout.port, layout.caption})
            covered += part.width * part.height;
        EXPECT_EQ(covered, scene.film.width * scene.film.height) << name << ", " << size;
    }
}

// In a small picture a row with all words would break the legend of the trails letter by letter.
TEST(Layout, ARowIsNotSqueezed) {
    FilmedScene scene = scene_of(320, 180, {0, 1});
    scene.film.title = "One";
    scene.film.shows.trails = {{0}, {}, 0.01};
    EXPECT_FALSE(plan_layout(scene).one_row);
}

TEST(Layout, AWideVesselHasItsWordsInOneRow) {
    const FilmedScene scene =
        read_filmed_scene(GRAINREEL_SOURCE "/scenes/conveyor.toml", {"film.size=854x480"}, measurable_in);
    const PictureLayout layout = plan_layout(scene);
    EXPECT_TRUE(layout.one_row);
    EXPECT_EQ(layout.port.width, scene.film.width);
    EXPECT_EQ(layout.first.y, layout.second.y);
}

TEST(Layout, PlatesStandAtTheSides) {
    FilmedScene scene = scene_of(640, 480, {0, 2});
    scene.film.words = WordPlace::plates;
    const PictureLayout layout = plan_layout(scene);
    EXPECT_TRUE(layout.plates);
    EXPECT_LT(layout.first.width, scene.film.width / 2);
    EXPECT_LT(layout.second.width, scene.film.width / 2);
}

TEST(Layout, LettersShrinkBeforeWordsAreLeftOut) {
    const FilmedScene roomy = scene_of(1920, 1080, {0, 2});
    const double whole = type_scale(roomy.film).main;
    EXPECT_DOUBLE_EQ(plan_layout(roomy).type.main, whole);
    // As species are added, the letters become smaller before the first name is missing.
    bool smaller = false;
    for (std::size_t kinds = 2; kinds < 12; ++kinds) {
        const PictureLayout layout = plan_layout(scene_of(1920, 1080, {1, kinds, true, true}));
        if (!layout.left_out.empty()) break;
        smaller = smaller || layout.type.main < 0.95 * whole;
    }
    EXPECT_TRUE(smaller);
    EXPECT_DOUBLE_EQ(type_scale(roomy.film, 0.8).main, 0.8 * whole);
    EXPECT_GE(type_scale(scene_of(320, 180, {}).film, 0.8).minor, 10);
}

// All captions of time of the film have their lines, whatever stands below them.
TEST(Layout, TheCaptionOfTimeHasAllItsLines) {
    for (const auto& [width, height] : {std::pair{560, 420}, {640, 360}, {480, 640}, {854, 480}})
        for (const std::size_t plots : {0u, 1u}) {
            FilmedScene scene = scene_of(width, height, {plots, 2});
            scene.film.segments.resize(2);
            scene.film.segments[0].playback = 0.1;
            scene.film.segments[1].kind = FilmSegment::Kind::locked;
            scene.film.segments[1].average = 1;
            const PictureLayout layout = plan_layout(scene);
            const Writer measure{nullptr, layout.type, make_palette({1, 1, 1})};
            const NumbersPlan plan = plan_numbers(measure, scene, layout);
            for (const std::string& caption : playback_captions(scene.film, scene.drive)) {
                const auto high = [&](int lines) {
                    return measure_text(caption, measure.minor(), plan.caption_wrap, lines).height;
                };
                EXPECT_EQ(high(plan.caption_lines), high(99)) << width << "x" << height << ": " << caption;
            }
            EXPECT_EQ(plan.plots.size(), plots) << width << "x" << height;
        }
}

// In a column without free height, the words of the first gutter make room for those about time.
TEST(Layout, AFullColumnKeepsTheLinesAboutTime) {
    int full = 0;
    for (int height = 300; height <= 700; height += 20) {
        FilmedScene scene = scene_of(480, height, {0, 3, true});
        scene.film.segments.resize(1);
        scene.film.segments[0].kind = FilmSegment::Kind::locked;
        scene.film.segments[0].average = 2;
        PictureLayout empty = bare_layout(scene.film);
        empty.type = type_scale(scene.film);
        const Writer measure{nullptr, empty.type, make_palette({1, 1, 1})};
        for (const PictureLayout& layout : laid_out(scene, empty, measure, GutterPlace::column)) {
            const NumbersPlan free = plan_numbers(measure, scene, layout.first.width, height, false, true);
            full += layout.first.height + free.height + layout.type.margin > height - 4;
            EXPECT_EQ(plan_numbers(measure, scene, layout).caption_lines, free.caption_lines)
                << height << ", column of " << layout.first.width;
        }
    }
    EXPECT_GT(full, 0);
}

// Films with other titles and other species have one layout where they ask for the same gutters.
TEST(Layout, IsOneForScenesThatShareTheirGutters) {
    for (const auto& [width, height] : {std::pair{960, 540}, {640, 640}, {540, 960}}) {
        std::vector<FilmedScene> scenes{scene_of(width, height, {1, 1}), scene_of(width, height, {1, 4})};
        scenes[1].film.title = "One";
        scenes[1].species[2].name = "grains with a long name";
        const FilmGutters gutters = gutters_for_all(scenes);
        ASSERT_TRUE(gutters.wanted) << width;
        EXPECT_NE(plan_layout(scenes[0]).port.width * plan_layout(scenes[0]).port.height,
                  plan_layout(scenes[1]).port.width * plan_layout(scenes[1]).port.height);
        for (FilmedScene& scene : scenes) scene.film.gutters = gutters;
        const PictureLayout one = plan_layout(scenes[0]), other = plan_layout(scenes[1]);
        EXPECT_EQ(std::tie(one.port.x, one.port.y, one.port.width, one.port.height),
                  std::tie(other.port.x, other.port.y, other.port.width, other.port.height))
            << width;
        EXPECT_EQ(one.type.main, other.type.main);
        EXPECT_TRUE(one.left_out.empty() && other.left_out.empty());
    }
}

// Nine species do not vanish: as many as fit are there, and the others are counted.
TEST(Layout, ALongLegendIsCutShort) {
    const FilmedScene scene = scene_of(640, 360, {2, 9, true, false});
    const PictureLayout layout = plan_layout(scene);
    const Palette palette = make_palette(scene.film.background);
    const Writer measure{nullptr, layout.type, palette};
    const FirstPart part = first_part(measure, scene, nullptr, layout, layout.first.width);
    EXPECT_TRUE(std::any_of(part.blocks.begin(), part.blocks.end(),
                            [](const FirstPart::Block& block) { return block.name == "legend"; }));
    const auto height = [&](double room) { return legend_block(measure, scene, 0, 0, 100, room).height; };
    const double all = height(0);
    std::size_t last = 9;
    for (double room = all; room > 20; room -= 5) {
        const std::size_t shown = species_in_legend(measure, scene, 100, room);
        EXPECT_LE(height(room), room);
        EXPECT_LE(shown, last);
        last = shown;
    }
    EXPECT_LT(last, 2u);
}

TEST(Layout, PlotsTakeFreeHeight) {
    for (const auto& [width, height] : {std::pair{1280, 720}, {720, 1280}}) {
        const FilmedScene scene = scene_of(width, height, {1, 1});
        const PictureLayout layout = plan_layout(scene);
        const Palette palette = make_palette(scene.film.background);
        const NumbersPlan plan = plan_numbers({nullptr, layout.type, palette}, scene, layout);
        ASSERT_EQ(plan.plots.size(), 1u);
        EXPECT_NEAR(plan.plots[0].y + plan.plots[0].height, layout.second.height - layout.type.margin, 2);
    }
}

TEST(Text, AWordThatIsALittleTooLongMakesTheLettersSmaller) {
    const TextStyle style{20, false};
    const double word = measure_text("displacement", style).width;
    EXPECT_LE(measure_text("displacement in mm", style, 0.8 * word, 3).width, 0.8 * word);
    // There are as many lines as words, so no word is broken.
    const double line = measure_text("x", style).height;
    EXPECT_LT(measure_text("displacement", style, 0.8 * word, 3).height, line);
    EXPECT_GT(measure_text("displacement", style, 0.3 * word, 5).height, 1.5 * line);
}

}  // namespace
}  // namespace grainreel::test
