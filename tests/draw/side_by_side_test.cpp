// Several scenes in one picture: scales, places, words that are said once.
#include "render/draw/side_by_side.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/measure/measure_table.hpp"
#include "tests/draw/support.hpp"

namespace grainreel {
namespace {

using namespace test;

Scene scene_with(double half_width, double g_level, double frequency = 20) {
    Scene scene = wedge();
    scene.name = "wedge";
    scene.container.half_width = half_width;
    scene.container.half_angle = 10 * pi / 180;
    scene.drive.frequency = frequency;
    scene.drive.amplitude = g_level * 9.81 / std::pow(2 * pi * frequency, 2);
    return scene;
}

std::vector<Panel> panels_of(const std::vector<Scene>& scenes) {
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

FramePtr one_ball(double radius) {
    return std::make_shared<const Frame>(frame_of({{Vec3(0, 0, 0.08), radius, 1}}));
}

bool inside(const Rectangle& inner, const Rectangle& outer) {
    return inner.x >= outer.x && inner.y >= outer.y && inner.x + inner.width <= outer.x + outer.width &&
           inner.y + inner.height <= outer.y + outer.height;
}

bool apart(const Rectangle& a, const Rectangle& b) {
    return a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y;
}

TEST(SideBySide, PanelsAndWordsNeitherOverlapNorLeaveThePicture) {
    for (const auto& [width, height] : {std::pair{1920, 1080}, {1280, 720}, {1080, 1920}, {800, 800}}) {
        for (std::size_t count = 2; count <= 6; ++count) {
            const PanelLayout layout =
                layout_of(panels_of(std::vector<Scene>(count, scene_with(0.06, 2))), film_of(width, height));
            ASSERT_EQ(layout.places.size(), count);
            std::vector<Rectangle> parts = {layout.top, layout.bottom};
            for (const PanelLayout::Place& place : layout.places)
                parts.insert(parts.end(), {place.caption, place.port, place.note, place.foot});
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
    std::vector<Scene> scenes = {scene_with(0.06, 1), scene_with(0.06, 3)};
    for (Scene& scene : scenes) {
        scene.film.shows.text = "mixing {lacey}";
        scene.film.shows.live_words = {{"mixing ", "lacey", "", 1}};
    }
    SideBySide drawing(panels_of(scenes), film_of(960, 540), 1, gl::Provider::automatic);
    const auto with_mixing = [](double lacey) {
        Frame frame = frame_of({{Vec3(0, 0, 0.08), 0.01, 1}});
        const auto table = std::make_shared<MeasureTable>(std::vector<std::string>{"time_s", "lacey"});
        table->add({0, lacey});
        frame.measures = table;
        frame.measure_rows = 1;
        return std::make_shared<const Frame>(std::move(frame));
    };
    const Picture before = drawing.draw({with_mixing(0.25), with_mixing(0.5)}, "");
    const Picture after = drawing.draw({with_mixing(0.25), with_mixing(0.75)}, "");
    const auto& places = drawing.layout().places;
    EXPECT_EQ(changed(before, after, places[0].note, 1).count, 0);
    EXPECT_GT(changed(before, after, places[1].note, 60).count, 10);
    EXPECT_EQ(changed(before, after, {0, 0, 960, 540}, 1).count,
              changed(before, after, places[1].note, 1).count);
}

TEST(SideBySide, ColourBarsAreSaidOnceOrUnderEach) {
    std::vector<Scene> scenes = {scene_with(0.06, 1), scene_with(0.06, 3)};
    EXPECT_EQ(layout_of(panels_of(scenes), film_of(960, 540)).places[0].foot.height, 0);
    const int plain = layout_of(panels_of(scenes), film_of(960, 540)).bottom.height;
    for (Scene& scene : scenes)
        scene.film.shows.colour = {GrainValue::speed, ColourMap::viridis, {0, 0.3}, false, "cm/s", 5};
    EXPECT_TRUE(common_of(panels_of(scenes)).colours);
    EXPECT_EQ(layout_of(panels_of(scenes), film_of(960, 540)).places[0].foot.height, 0);
    EXPECT_GE(layout_of(panels_of(scenes), film_of(960, 540)).bottom.height, plain);
    scenes[1].film.shows.colour.range = {0, 0.6};
    EXPECT_FALSE(common_of(panels_of(scenes)).colours);
    EXPECT_GT(layout_of(panels_of(scenes), film_of(960, 540)).places[0].foot.height, 20);
}

TEST(SideBySide, ATooSmallPictureHasNoPlaces) {
    EXPECT_TRUE(
        layout_of(panels_of(std::vector<Scene>(6, scene_with(0.06, 2))), film_of(160, 120)).places.empty());
}

// In the middle of a container a ball of radius r is as wide as 2 r times the common scale, in each panel.
TEST(SideBySide, OneScaleHoldsInAllPanels) {
    const std::vector<Panel> panels = panels_of({scene_with(0.075, 2), scene_with(0.05, 2)});
    SideBySide picture(panels, film_of(1280, 720), 1, gl::Provider::automatic);
    ASSERT_GT(picture.layout().scale, 0);
    const double radius = 0.012;
    const Picture without = picture.draw({one_ball(1e-6), one_ball(1e-6)}, "");
    const Picture with = picture.draw({one_ball(radius), one_ball(radius)}, "");
    for (const PanelLayout::Place& place : picture.layout().places) {
        const test::Extent ball = changed(without, with, place.port, 40);
        EXPECT_NEAR(ball.right - ball.left, 2 * radius * picture.layout().scale, 3);
    }
}

TEST(SideBySide, EqualFramesGiveEqualPanels) {
    const std::vector<Panel> panels = panels_of({scene_with(0.06, 2), scene_with(0.06, 2)});
    SideBySide picture(panels, film_of(640, 360), 1, gl::Provider::automatic);
    const Picture& drawn = picture.draw({one_ball(0.01), one_ball(0.01)}, "");
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
    Scene large = scene_with(0.075, 2);
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
    Frame later = *one_ball(0.01);
    later.time = 0.5;
    const FramePtr now = one_ball(0.01), then = std::make_shared<const Frame>(later);
    const Picture first = picture.draw({now, then}, "", 0), same = picture.draw({now, now}, "", 0),
                  second = picture.draw({now, then}, "", 1);
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
    Scene still = scene_with(0.06, 3);
    still.drive = {};
    EXPECT_THAT(captions_of({still, scene_with(0.06, 3)}),
                ElementsAre("no vibration", testing::HasSubstr("Γ = 3")));
    Scene floating = scene_with(0.06, 3), further = scene_with(0.06, 6);
    floating.gravity = further.gravity = Vec3(0, 0, 0);
    EXPECT_THAT(captions_of({floating, further}),
                ElementsAre(testing::HasSubstr("a = "), testing::HasSubstr("a = ")));
    Scene other = scene_with(0.06, 3);
    other.film.title = "Another";
    EXPECT_THAT(captions_of({scene_with(0.06, 3), other}), ElementsAre("A wedge", "Another"));
    Scene named = scene_with(0.06, 3);
    named.name = "second";
    EXPECT_THAT(captions_of({scene_with(0.06, 3), named}), ElementsAre("wedge", "second"));
    Scene slow = scene_with(0.06, 3, 15), third = scene_with(0.06, 3, 15);
    third.film.title = "Another";
    EXPECT_THAT(captions_of({scene_with(0.06, 3), slow, third}),
                ElementsAre("A wedge: f = 20 Hz", "A wedge: f = 15 Hz", "Another: f = 15 Hz"));
    EXPECT_THAT(captions_of({slow, slow}), ElementsAre("1, wedge", "2, wedge"));
}

TEST(SideBySide, OneRangeOfColoursHoldsInAllPanels) {
    std::vector<Scene> scenes = {scene_with(0.06, 1), scene_with(0.06, 3)};
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
    panels[0].scene.film.shows.colour.fixed = true;  // its own scene asks for it
    share_colours(panels);
    EXPECT_EQ(panels[1].scene.film.shows.colour.range[1], 0.1 + 0.2);
    EXPECT_EQ(panels[0].scene.film.shows.colour.range[1], 0.1);
}

}  // namespace
}  // namespace grainreel
