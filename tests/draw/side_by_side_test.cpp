// Tests of several scenes in one picture: their scales and places, and words that stand only once.
#include "render/picture/panels/side_by_side.hpp"
#include "render/picture/base/shot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/measure/measures.hpp"
#include "engine/plan/reach.hpp"
#include "render/picture/camera/framing.hpp"
#include "render/picture/panels/panel_words.hpp"
#include "render/picture/plots/plot.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel {
namespace {

using namespace test;

FilmedScene scene_with(double half_width, double g_level, double frequency = 20) {
    FilmedScene scene = wedge();
    scene.name = "wedge";
    scene.container.half_width = half_width;
    scene.container.half_angle = 10 * pi / 180;
    scene.drive.frequency = frequency;
    scene.drive.amplitude = g_level * 9.81 / std::pow(2 * pi * frequency, 2);
    return scene;
}

std::vector<Panel> panels_of(const std::vector<FilmedScene>& scenes) {
    const std::vector<std::string> captions = captions_of(scenes);
    std::vector<Panel> panels;
    for (std::size_t i = 0; i < scenes.size(); ++i) panels.push_back({scenes[i], captions[i]});
    return panels;
}

Film film_of(int width, int height) {
    Film film;
    film.width = width;
    film.height = height;
    film.title = "Together";
    return film;
}

ShotPtr one_ball(double radius) {
    return std::make_shared<const Shot>(frame_of({{Vec3(0, 0, 0.08), radius, 1}}));
}

bool inside(const Rectangle& inner, const Rectangle& outer) {
    return inner.x >= outer.x && inner.y >= outer.y && inner.x + inner.width <= outer.x + outer.width &&
           inner.y + inner.height <= outer.y + outer.height;
}

bool apart(const Rectangle& a, const Rectangle& b) {
    return a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y;
}

// Panels that have two plots, marks and words of their own each.
std::vector<Panel> full_panels(std::size_t count) {
    std::vector<Panel> panels = panels_of(std::vector<FilmedScene>(count, scene_with(0.06, 2)));
    for (std::size_t i = 0; i < count; ++i) {
        FilmShows& shows = panels[i].scene.film.shows;
        shows.plots = {{"height_difference", "height difference", {}}, {"lacey", "mixing", {}}};
        shows.text = "mixing {lacey}";
        shows.live_words = {{"mixing ", "lacey", "", 1}};
        shows.arrows = {10, 0.1 * static_cast<double>(i + 1), false};
        panels[i].playback = {i == 0 ? "1 frame a period at phase 0 (plays 1.5×)" : "time lapse, 1.5× speed"};
    }
    return panels;
}

TEST(SideBySide, PanelsAndWordsNeitherOverlapNorLeaveThePicture) {
    for (const auto& [width, height] : {std::pair{1920, 1080}, {1280, 720}, {1080, 1920}, {800, 800}}) {
        for (std::size_t count = 2; count <= 12; ++count) {
            const std::vector<Panel> panels =
                count <= 6 ? panels_of(std::vector<FilmedScene>(count, scene_with(0.06, 2)))
                           : full_panels(count - 5);
            const PanelLayout layout = layout_of(panels, film_of(width, height));
            ASSERT_EQ(layout.places.size(), panels.size());
            std::vector<Rectangle> parts = {layout.top, layout.bottom};
            for (const PanelLayout::Place& place : layout.places) {
                parts.insert(parts.end(), {place.caption, place.pace, place.port, place.note, place.foot});
                parts.insert(parts.end(), place.plots.begin(), place.plots.end());
            }
            for (std::size_t i = 0; i < parts.size(); ++i) {
                EXPECT_TRUE(inside(parts[i], {0, 0, width, height})) << width << ' ' << count << ' ' << i;
                for (std::size_t k = 0; k < i; ++k)
                    EXPECT_TRUE(parts[k].height == 0 || parts[i].height == 0 || apart(parts[i], parts[k]))
                        << width << ' ' << count << ' ' << i << ' ' << k;
            }
        }
    }
}

// Live words under each panel follow its own measures, and change nothing else.
TEST(SideBySide, LiveWordsAreThoseOfTheirPanel) {
    std::vector<FilmedScene> scenes = {scene_with(0.06, 1), scene_with(0.06, 3)};
    for (FilmedScene& scene : scenes) {
        scene.film.shows.text = "mixing {lacey}";
        scene.film.shows.live_words = {{"mixing ", "lacey", "", 1}};
    }
    SideBySide drawing(panels_of(scenes), film_of(960, 540), 1, gl::Provider::automatic);
    const auto with_mixing = [](double lacey) {
        Shot frame = frame_of({{Vec3(0, 0, 0.08), 0.01, 1}});
        const auto table = std::make_shared<MeasureTable>(std::vector<std::string>{"time_s", "lacey"});
        table->add({0, lacey});
        frame.measures = table;
        frame.measure_rows = 1;
        return std::make_shared<const Shot>(std::move(frame));
    };
    const Picture before = drawing.draw({with_mixing(0.25), with_mixing(0.5)});
    const Picture after = drawing.draw({with_mixing(0.25), with_mixing(0.75)});
    const auto& places = drawing.layout().places;
    EXPECT_EQ(changed(before, after, places[0].note, 1).count, 0);
    EXPECT_GT(changed(before, after, places[1].note, 60).count, 10);
    EXPECT_EQ(changed(before, after, {0, 0, 960, 540}, 1).count,
              changed(before, after, places[1].note, 1).count);
}

ShotPtr with_rows(const std::vector<double>& values) {
    Shot frame = frame_of({{Vec3(0, 0, 0.08), 0.01, 1}});
    const auto table = std::make_shared<MeasureTable>(std::vector<std::string>{"time_s", "lacey"});
    for (std::size_t i = 0; i < values.size(); ++i) table->add({0.1 * static_cast<double>(i), values[i]});
    frame.measures = table;
    frame.measure_rows = values.size();
    return std::make_shared<const Shot>(std::move(frame));
}

std::vector<Panel> plotted_panels() {
    std::vector<FilmedScene> scenes = {scene_with(0.06, 1), scene_with(0.06, 3)};
    for (FilmedScene& scene : scenes) {
        scene.run.duration = 1;
        scene.film.shows.plots = {{"lacey", "mixing", {}}};
    }
    return panels_of(scenes);
}

// Curves need enough pixels, however small the letters around them are. Plots without room are left out.
TEST(SideBySide, PlotsAreLargeEnoughToBeReadOrLeftOut) {
    constexpr double curves = 48, lines = 5;  // pixels for the curves; lines of words above and below
    int with = 0, without = 0;
    for (const auto& [width, height] : {std::pair{640, 360}, {480, 270}, {1280, 720}, {1920, 1080}})
        for (std::size_t count = 2; count <= 6; ++count) {
            const Film film = film_of(width, height);
            const PanelLayout layout = layout_of(full_panels(count), film);
            if (layout.places.empty()) continue;
            (layout.plots_fit ? with : without) += 1;
            const double room = curves + lines * panel_type(film).minor - panel_type(film).gap - 1;
            for (const PanelLayout::Place& place : layout.places)
                for (const Rectangle& plot : place.plots)
                    EXPECT_GE(plot.height, room) << width << " x " << height << ", " << count;
        }
    EXPECT_GT(with, 0);
    EXPECT_GT(without, 0);
}

// If there is free height beside a port, words do not take room from the curves.
TEST(SideBySide, CurvesBesideAPanelAreThreeQuartersAsHighAsThePlotIsWide) {
    constexpr double upright = 0.75, lines = 5;  // lines of words above and below the curves
    const Film film = film_of(1280, 720);
    for (const PanelLayout::Place& place : layout_of(plotted_panels(), film).places) {
        const Rectangle& plot = place.plots.at(0);
        ASSERT_GE(plot.x, place.port.x + place.port.width);
        const double asked = upright * plot.width + lines * panel_type(film).minor;
        EXPECT_GE(plot.height, std::min<double>(asked, place.port.height - panel_type(film).gap) - 2);
        EXPECT_LE(plot.height, place.port.height);
    }
}

// A caption of time that all scenes have stands once below them; each scene's own caption stands under its
// panel.
TEST(SideBySide, CaptionsOfAllStandOnce) {
    std::vector<Panel> panels = panels_of({scene_with(0.06, 1), scene_with(0.06, 3)});
    for (Panel& panel : panels) panel.scene.film.captions = {{0, 1, "The bed flies", 0}};
    const double below = layout_of(panels, film_of(960, 540)).bottom.height;
    SideBySide once(panels, film_of(960, 540), 1, gl::Provider::automatic);
    EXPECT_EQ(once.layout().places[0].note.height, 0);
    const ShotPtr now = one_ball(0.01);
    Shot later = *now;
    later.time = 2;
    const Picture with = once.draw({now, now});
    const Picture without =
        once.draw({std::make_shared<const Shot>(later), std::make_shared<const Shot>(later)});
    const Rectangle bottom = once.layout().bottom;
    const Rectangle row{bottom.x, bottom.y, bottom.width, bottom.height / 3};
    EXPECT_GT(changed(with, without, row, 60).count, 50);
    panels[1].scene.film.captions.clear();
    const PanelLayout own = layout_of(panels, film_of(960, 540));
    EXPECT_GT(own.places[0].note.height, 0);
    EXPECT_LT(own.bottom.height, below);
}

// A plot follows the rows of its own panel, on axes that hold the rows of all panels.
TEST(SideBySide, PlotsAreThoseOfTheirPanelOnOneSpan) {
    const std::vector<Panel> panels = plotted_panels();
    SideBySide drawing(panels, film_of(960, 540), 1, gl::Provider::automatic);
    const auto& places = drawing.layout().places;
    ASSERT_TRUE(drawing.layout().plots_fit);
    ASSERT_EQ(places[0].plots.size(), 1u);
    const Picture before = drawing.draw({with_rows({0, 1, 0.5}), with_rows({0.2, 0.4, 0.5})});
    const Picture after = drawing.draw({with_rows({0, 1, 0.5}), with_rows({0.2, 0.4, 0.7})});
    EXPECT_EQ(changed(before, after, places[0].plots[0], 1).count, 0);
    EXPECT_GT(changed(before, after, places[1].plots[0], 60).count, 10);
    EXPECT_EQ(changed(before, after, {0, 0, 960, 540}, 1).count,
              changed(before, after, places[1].plots[0], 1).count);
    const TypeScale type = panel_type(film_of(960, 540));
    PanelPlots plots(panels, drawing.layout(), type, make_palette({1, 1, 1}));
    plots.take({with_rows({0, 1, 0.5}), with_rows({0.2, 0.4, 0.5})});
    const auto& first = dynamic_cast<const Plot&>(*plots.all()[0].plot);
    const auto& second = dynamic_cast<const Plot&>(*plots.all()[1].plot);
    for (const double value : {0.0, 0.3, 1.0}) EXPECT_EQ(first.y_of(value), second.y_of(value));
    EXPECT_GT(second.y_of(0.9), second.y_of(1.0));  // the plot is not cut off at the end of its own rows
    for (const double time : {0.0, 0.7}) EXPECT_EQ(first.x_of(time), second.x_of(time));
}

TEST(SideBySide, PlotsWithoutRoomAreLeftOut) {
    const PanelLayout small = layout_of(plotted_panels(), film_of(320, 240));
    ASSERT_FALSE(small.places.empty());
    EXPECT_FALSE(small.plots_fit);
    EXPECT_TRUE(small.places[0].plots.empty());
}

// Words that are true for all panels stand once; otherwise each panel has its own.
TEST(SideBySide, TimeIsSaidOverEachPanelWhereItIsUnlike) {
    std::vector<Panel> panels = panels_of({scene_with(0.06, 1, 20), scene_with(0.06, 1, 25)});
    for (Panel& panel : panels) panel.playback = {"slow motion, 1/10 speed", "real time"};
    EXPECT_EQ(layout_of(panels, film_of(960, 540)).places[0].pace.height, 0);
    SideBySide alike(panels, film_of(960, 540), 1, gl::Provider::automatic);
    panels[1].playback[1] = "on average 1 frame every 1.25 periods, at phase 0 (plays 1.5×)";
    SideBySide unlike(panels, film_of(960, 540), 1, gl::Provider::automatic);
    const std::vector<ShotPtr> frames = {one_ball(0.01), one_ball(0.01)};
    const Picture first = alike.draw(frames, 0), then = alike.draw(frames, 1);
    EXPECT_EQ(changed(first, then, alike.layout().bottom, 1).count,
              changed(first, then, {0, 0, 960, 540}, 1).count);
    EXPECT_GT(changed(first, then, alike.layout().bottom, 60).count, 10);
    const Picture slow = unlike.draw(frames, 0), plain = unlike.draw(frames, 1);
    EXPECT_EQ(changed(slow, plain, unlike.layout().bottom, 1).count, 0);
    for (const PanelLayout::Place& place : unlike.layout().places)
        EXPECT_GT(changed(slow, plain, place.pace, 60).count, 10);
}

TEST(SideBySide, MarksAreExplainedOnceOrUnderEach) {
    std::vector<FilmedScene> scenes = {scene_with(0.06, 1), scene_with(0.06, 3)};
    const int bare = layout_of(panels_of(scenes), film_of(640, 960)).bottom.height;
    for (FilmedScene& scene : scenes) scene.film.shows.trails = {{0}, {}, 0.1};
    const PanelLayout once = layout_of(panels_of(scenes), film_of(640, 960));
    EXPECT_GT(once.bottom.height, bare);
    EXPECT_EQ(once.places[0].foot.height, 0);
    scenes[1].film.shows.trails.duration = 0.2;
    const PanelLayout each = layout_of(panels_of(scenes), film_of(640, 960));
    EXPECT_EQ(each.bottom.height, bare);
    EXPECT_GT(each.places[0].foot.height, 10);
}

TEST(SideBySide, WithoutABackgroundThePaperShowsThrough) {
    Film film = film_of(640, 360);
    film.transparent = true;
    SideBySide drawing(plotted_panels(), film, 1, gl::Provider::automatic);
    const Picture& picture = drawing.draw({with_rows({0, 1}), with_rows({0, 1})});
    const auto share_empty = [&](const Rectangle& part) {
        int empty = 0;
        for (int y = part.y; y < part.y + part.height; ++y)
            for (int x = part.x; x < part.x + part.width; ++x) empty += picture.pixel(x, y)[3] == 0;
        return static_cast<double>(empty) / (part.width * part.height);
    };
    const PanelLayout::Place& place = drawing.layout().places[0];
    for (const Rectangle& part :
         {drawing.layout().top, drawing.layout().bottom, place.caption, place.port, place.plots[0]}) {
        EXPECT_GT(share_empty(part), 0.15);
        EXPECT_LT(share_empty(part), 1);
    }
}

TEST(SideBySide, ColourBarsAreSaidOnceOrUnderEach) {
    std::vector<FilmedScene> scenes = {scene_with(0.06, 1), scene_with(0.06, 3)};
    EXPECT_EQ(layout_of(panels_of(scenes), film_of(960, 540)).places[0].foot.height, 0);
    const int plain = layout_of(panels_of(scenes), film_of(960, 540)).bottom.height;
    for (FilmedScene& scene : scenes)
        scene.film.shows.colour = {GrainValue::speed, ColourMap::viridis, {0, 0.3}, false, "cm/s", 5};
    EXPECT_TRUE(common_of(panels_of(scenes)).colours);
    EXPECT_EQ(layout_of(panels_of(scenes), film_of(960, 540)).places[0].foot.height, 0);
    EXPECT_GE(layout_of(panels_of(scenes), film_of(960, 540)).bottom.height, plain);
    scenes[1].film.shows.colour.range = {0, 0.6};
    EXPECT_FALSE(common_of(panels_of(scenes)).colours);
    EXPECT_GT(layout_of(panels_of(scenes), film_of(960, 540)).places[0].foot.height, 20);
}

TEST(SideBySide, ATooSmallPictureHasNoPlaces) {
    EXPECT_TRUE(layout_of(panels_of(std::vector<FilmedScene>(6, scene_with(0.06, 2))), film_of(160, 120))
                    .places.empty());
}

// In the middle of each panel's container, a ball of radius r is as wide as 2 r times the common scale.
TEST(SideBySide, OneScaleHoldsInAllPanels) {
    std::vector<Panel> panels = panels_of({scene_with(0.075, 2), scene_with(0.05, 2)});
    for (Panel& panel : panels) {  // what a ball takes of the light on the walls
        panel.scene.film.look.shadows = false;
        panel.scene.film.look.occlusion = false;
    }
    SideBySide picture(panels, film_of(1280, 720), 1, gl::Provider::automatic);
    ASSERT_GT(picture.layout().scale, 0);
    const double radius = 0.012;
    const Picture without = picture.draw({one_ball(1e-6), one_ball(1e-6)});
    const Picture with = picture.draw({one_ball(radius), one_ball(radius)});
    for (const PanelLayout::Place& place : picture.layout().places) {
        const test::Extent ball = changed(without, with, place.port, 40);
        EXPECT_NEAR(ball.right - ball.left, 2 * radius * picture.layout().scale, 3);
    }
}

TEST(SideBySide, EqualFramesGiveEqualPanels) {
    const std::vector<Panel> panels = panels_of({scene_with(0.06, 2), scene_with(0.06, 2)});
    SideBySide picture(panels, film_of(640, 360), 1, gl::Provider::automatic);
    const Picture& drawn = picture.draw({one_ball(0.01), one_ball(0.01)});
    const Rectangle a = picture.layout().places[0].port, b = picture.layout().places[1].port;
    ASSERT_EQ(a.width, b.width);
    int different = 0, coloured = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            const std::uint8_t *p = drawn.pixel(a.x + x, a.y + y), *q = drawn.pixel(b.x + x, b.y + y);
            different += !std::equal(p, p + 4, q);
            coloured += p[0] > p[2] + 60;
        }
    EXPECT_EQ(different, 0);
    EXPECT_GT(coloured, 100);  // the orange ball is there
}

TEST(SideBySide, ContainersTooUnlikeHaveAScaleEach) {
    const std::vector<Panel> near = panels_of({scene_with(0.075, 2), scene_with(0.05, 2)});
    EXPECT_GT(layout_of(near, film_of(1280, 720)).scale, 0);
    FilmedScene large = scene_with(0.075, 2);
    for (double* length : {&large.container.half_width, &large.container.depth, &large.container.height,
                           &large.container.slant_height, &large.drive.amplitude})
        *length *= 5;
    const PanelLayout layout = layout_of(panels_of({scene_with(0.075, 2), large}), film_of(1280, 720));
    EXPECT_EQ(layout.scale, 0);
    EXPECT_GT(layout.places[0].foot.height, 0);  // for a bar of its own
}

TEST(SideBySide, TheClockIsThatOfItsPanel) {
    const std::vector<Panel> panels = panels_of({scene_with(0.06, 2), scene_with(0.06, 3)});
    SideBySide picture(panels, film_of(640, 360), 1, gl::Provider::automatic);
    Shot later = *one_ball(0.01);
    later.time = 0.5;
    const ShotPtr now = one_ball(0.01), then = std::make_shared<const Shot>(later);
    const Picture first = picture.draw({now, then}, 0, 0), same = picture.draw({now, now}, 0, 0),
                  second = picture.draw({now, then}, 0, 1);
    const Rectangle& words = picture.layout().bottom;
    EXPECT_EQ(changed(first, same, words).count, 0);
    EXPECT_GT(changed(first, second, words).count, 0);
}

TEST(Captions, SayWhatTellsTheScenesApart) {
    using testing::ElementsAre;
    EXPECT_THAT(captions_of({scene_with(0.06, 0.9), scene_with(0.06, 3)}), ElementsAre("Γ = 0.9", "Γ = 3"));
    EXPECT_THAT(captions_of({scene_with(0.06, 3, 15), scene_with(0.06, 3, 20)}),
                ElementsAre("f = 15 Hz", "f = 20 Hz"));
    EXPECT_THAT(captions_of({scene_with(0.06, 2, 15), scene_with(0.06, 3, 20)}),
                ElementsAre("f = 15 Hz, Γ = 2", "f = 20 Hz, Γ = 3"));
    FilmedScene still = scene_with(0.06, 3);
    still.drive = {};
    EXPECT_THAT(captions_of({still, scene_with(0.06, 3)}),
                ElementsAre("no vibration", testing::HasSubstr("Γ = 3")));
    FilmedScene floating = scene_with(0.06, 3), further = scene_with(0.06, 6);
    floating.gravity = further.gravity = Vec3(0, 0, 0);
    EXPECT_THAT(captions_of({floating, further}),
                ElementsAre(testing::HasSubstr("a = "), testing::HasSubstr("a = ")));
    FilmedScene other = scene_with(0.06, 3);
    other.film.title = "Another";
    EXPECT_THAT(captions_of({scene_with(0.06, 3), other}), ElementsAre("A wedge", "Another"));
    other.drive.amplitude *= 2;
    EXPECT_THAT(captions_of({scene_with(0.06, 3), other}), ElementsAre("A wedge\nΓ = 3", "Another\nΓ = 6"));
    other.film.title = "A wedge at Γ = 6";
    EXPECT_THAT(captions_of({scene_with(0.06, 3), other}), ElementsAre("A wedge\nΓ = 3", "A wedge at Γ = 6"));
    FilmedScene named = scene_with(0.06, 3);
    named.name = "second";
    EXPECT_THAT(captions_of({scene_with(0.06, 3), named}), ElementsAre("wedge", "second"));
    FilmedScene slow = scene_with(0.06, 3, 15), third = scene_with(0.06, 3, 15);
    third.film.title = "Another";
    EXPECT_THAT(captions_of({scene_with(0.06, 3), slow, third}),
                ElementsAre("A wedge\nf = 20 Hz", "A wedge\nf = 15 Hz", "Another\nf = 15 Hz"));
    EXPECT_THAT(captions_of({slow, slow}), ElementsAre("1, wedge", "2, wedge"));
}

TEST(SideBySide, OneRangeOfColoursHoldsInAllPanels) {
    std::vector<FilmedScene> scenes = {scene_with(0.06, 1), scene_with(0.06, 3)};
    for (std::size_t i = 0; i < 2; ++i) {
        GrainColouring& colour = scenes[i].film.shows.colour;
        colour.by = GrainValue::speed;
        colour.range = {0, 0.1 + 0.2 * static_cast<double>(i)};
        colour.unit = i == 0 ? "mm/s" : "cm/s";
    }
    std::vector<Panel> panels = panels_of(scenes);
    share_colours(panels);
    for (const Panel& panel : panels) {
        EXPECT_EQ(panel.scene.film.shows.colour.range, (std::array<double, 2>{0, 0.1 + 0.2}));
        EXPECT_EQ(panel.scene.film.shows.colour.unit, "cm/s");
    }
    panels = panels_of(scenes);
    panels[0].scene.film.shows.colour.fixed = true;  // the panel's own scene asks for it
    share_colours(panels);
    EXPECT_EQ(panels[1].scene.film.shows.colour.range[1], 0.1 + 0.2);
    EXPECT_EQ(panels[0].scene.film.shows.colour.range[1], 0.1);
}

// Grains fly higher in the panel with the stronger drive; the containers are alike.
TEST(SideBySide, PanelsFrameOneHeight) {
    std::vector<FilmedScene> scenes = {scene_with(0.06, 2), scene_with(0.06, 5)};
    for (FilmedScene& scene : scenes) {
        scene.film.camera.frame = FramingScope::reach;
        scene.container.height = 0.5;
    }
    std::vector<Panel> panels = panels_of(scenes);
    ASSERT_LT(*estimated_reach(scenes[0]), *estimated_reach(scenes[1]));
    share_reach(panels);
    for (const Panel& panel : panels) EXPECT_EQ(framed_part(panel.scene).top, framed_part(scenes[1]).top);
    panels[0].scene.film.camera.frame = FramingScope::container;  // the panel's own scene asks for it
    panels[1].scene.film.camera.reach.reset();
    share_reach(panels);
    EXPECT_FALSE(panels[1].scene.film.camera.reach);
}

}  // namespace
}  // namespace grainreel
