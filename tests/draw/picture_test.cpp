// Tests of whole pictures: they are repeatable and the same on any number of threads, and words do not touch
// grains.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>

#include "engine/base/error.hpp"
#include "engine/measure/measures.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/gl/opengl.hpp"
#include "render/picture/words/captions.hpp"
#include "render/scene/film.hpp"
#include "tests/draw/support.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {
namespace {

Shot scattered(int count) {
    std::mt19937 random(7);
    const auto between = [&](double a, double b) {
        return a + (b - a) * static_cast<double>(random()) / 4294967296.0;
    };
    std::vector<Ball> balls;
    for (int i = 0; i < count; ++i)
        balls.push_back({{between(-0.015, 0.015), between(-0.04, 0.04), between(0.01, 0.12)},
                         i % 9 ? 0.0025 : 0.005,
                         i % 9 ? 0 : 1});
    Shot frame = frame_of(balls);
    frame.time = 3.2625;
    frame.cycles = 65.25;
    frame.phase = 0.25;
    return frame;
}

TEST(Pictures, TheSameFrameTwiceIsTheSamePicture) {
    Renderer renderer(wedge(), 1);
    const Shot frame = scattered(500);
    const Picture first = renderer.draw(frame, "slow motion 1/10");
    renderer.draw(frame_of({{{0, 0, 0.1}, 0.02, 1}}), "something else");
    EXPECT_EQ(renderer.draw(frame, "slow motion 1/10").rgba, first.rgba);
    renderer.draw_timed(frame, "slow motion 1/10");
    EXPECT_EQ(renderer.draw(frame, "slow motion 1/10").rgba, first.rgba);
}

TEST(Pictures, AStillSceneIsThirtyTimesTheSamePicture) {
    FilmedScene scene = wedge();
    scene.film.look.ground = true;
    Renderer renderer(scene, 2);
    Shot frame = scattered(800);
    const Picture first = renderer.draw(frame, "");
    for (int again = 0; again < 30; ++again) ASSERT_EQ(renderer.draw(frame, "").rgba, first.rgba) << again;
}

// Walls and shadows are drawn again only where they have changed.
TEST(Pictures, WhatMovesLeavesNothingBehind) {
    FilmedScene scene = wedge();
    scene.film.look.ground = true;
    const Shot full = scattered(800), empty = frame_of({});
    std::vector<Shot> frames;
    for (const double offset : {0.0, 0.03, 0.03, -0.01, 0.0})
        for (const Shot* grains : {&full, &empty}) {
            frames.push_back(*grains);
            frames.back().container().place = {0, 0, offset};
            frames.back().floor().place = {0, 0.5 * offset, 0.2 * offset};
        }
    std::vector<Picture> alone;
    for (const Shot& frame : frames) alone.push_back(Renderer(scene, 1).draw(frame, ""));
    Renderer renderer(scene, 1);
    for (std::size_t i = 0; i < frames.size(); ++i)
        EXPECT_EQ(changed(alone[i], renderer.draw(frames[i], ""), renderer.view().port).count, 0) << i;
}

// Frames are drawn in turn into three pictures. Each picture is the same as one drawn alone, and pictures
// with the same number differ only where they say that they may.
TEST(Pictures, AreAlikeOutsideOfWhatMoves) {
    const FilmedScene scene = wedge();
    Renderer renderer(scene, 1);
    std::array<Picture, 3> ring;
    for (std::size_t i = 0; i < 9; ++i) {
        Shot frame = scattered(100 + 50 * static_cast<int>(i));
        frame.time += 0.013 * static_cast<double>(i);
        frame.phase = 0.1 * static_cast<double>(i);
        const std::string playback = i / 2 % 2 ? "slow motion" : "";
        Picture& picture = ring[i % 3];
        renderer.draw_into(picture, frame, playback, 0);
        EXPECT_EQ(picture.rgba, Renderer(scene, 1).draw(frame, playback).rgba) << i;
        ASSERT_NE(picture.still, 0u);
        const Picture& last = ring[(i + 2) % 3];
        if (i == 0) continue;
        EXPECT_EQ(picture.still, last.still);
        Picture masked = last;
        for (const Rectangle& part : picture.moving)
            for (int y = part.y; y < part.y + part.height; ++y)
                std::copy_n(picture.pixel(part.x, y), 4 * part.width, masked.pixel(part.x, y));
        EXPECT_EQ(picture.rgba, masked.rgba) << i;
    }
}

// A transparent picture laid over a colour is the same as one drawn on that colour.
TEST(Pictures, TransparentOnesHaveTheRightAlphaAlongEveryEdge) {
    FilmedScene scene = wedge();
    scene.container.shape = Container::Shape::none;
    const Shot frame = scattered(300);
    const PictureLayout layout = bare_layout(scene.film);
    scene.film.transparent = true;
    const Picture clear = Renderer(scene, layout, 1, gl::Provider::automatic).draw(frame, "");
    scene.film.transparent = false;
    int soft = 0;
    for (const Colour& background : {Colour{1, 1, 1}, Colour{0, 0, 0}, Colour{0.8, 0.2, 0.4}}) {
        scene.film.background = background;
        const Picture drawn = Renderer(scene, layout, 1, gl::Provider::automatic).draw(frame, "");
        for (std::size_t i = 0; i < drawn.rgba.size(); i += 4) {
            const double alpha = clear.rgba[i + 3] / 255.0;
            soft += alpha > 0.1 && alpha < 0.9;
            const double below[3] = {background.red, background.green, background.blue};
            for (std::size_t c = 0; c < 3; ++c)
                ASSERT_NEAR(drawn.rgba[i + c], alpha * clear.rgba[i + c] + (1 - alpha) * 255 * below[c], 2)
                    << i / 4;
        }
    }
    EXPECT_GT(soft, 500);
}

// Mesa reads its number of threads once in each process, so each number needs a process of its own: this
// test, run again with a file into which it writes the picture.
TEST(Pictures, RasterThreadsDoNotChangeThem) {
    const char* const variable = "GRAINREEL_TEST_THREADS";
    if (const char* job = std::getenv(variable)) {
        const std::string text = job;
        Renderer renderer(wedge(), std::stoi(text));
        const Picture& picture = renderer.draw(scattered(800), "two threads or one");
        std::ofstream(text.substr(text.find(' ') + 1), std::ios::binary)
            .write(reinterpret_cast<const char*>(picture.rgba.data()),
                   static_cast<std::streamsize>(picture.rgba.size()));
        return;
    }
    const test::TemporaryFolder folder;
    const auto drawn = [&](int threads) {
        const auto file = folder / std::to_string(threads);
        const pid_t child = fork();
        if (child == 0) {
            setenv(variable, (std::to_string(threads) + " " + file.string()).c_str(), 1);
            execl("/proc/self/exe", "test_draw", "--gtest_filter=Pictures.RasterThreadsDoNotChangeThem",
                  nullptr);
            _exit(127);
        }
        int status = -1;
        waitpid(child, &status, 0);
        EXPECT_EQ(status, 0);
        return test::text_of(file);
    };
    const std::string one = drawn(1);
    EXPECT_EQ(one.size(), 640u * 360u * 4u);
    EXPECT_TRUE(one == drawn(2));
}

void expect_same(const Picture& a, const Picture& b, const Rectangle& part) {
    for (int y = part.y; y < part.y + part.height; ++y)
        for (int x = part.x; x < part.x + part.width; ++x)
            ASSERT_EQ(difference(a, b, x, y), 0) << "at " << x << ", " << y;
}

TEST(Pictures, WordsAndGrainsKeepApart) {
    for (const auto& [width, height] : {std::pair{640, 360}, {360, 640}}) {
        const FilmedScene scene = wedge(width, height);
        const PictureLayout layout = plan_layout(scene);
        Renderer renderer(scene, 1);
        Shot frame = frame_of({});
        const Picture empty = renderer.draw(frame, "caption");
        // Grains lie everywhere, also far outside the container; the gutters do not change.
        frame = frame_of({{{0, 0, 0.1}, 0.05, 1},
                          {{0, -0.3, 0.1}, 0.2, 0},
                          {{0, 0.3, 0.1}, 0.2, 0},
                          {{0, 0, 0.6}, 0.3, 0}});
        const Picture full = renderer.draw(frame, "caption");
        expect_same(empty, full, layout.first);
        expect_same(empty, full, layout.second);
        EXPECT_GT(changed(empty, full, layout.port).count, 1000);
        // The words change; the grains do not.
        frame.time = 8.5;
        frame.cycles = 170.3;
        frame.phase = 0.3;
        const Picture later = renderer.draw(frame, "another caption, and a much longer one than before");
        expect_same(full, later, layout.port);
        expect_same(full, later, layout.first);
        EXPECT_GT(changed(full, later, layout.second).count, 20);
    }
}

// Contrast of two colours in bytes, as WCAG 2.2 defines it.
double wcag_contrast(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    const auto light = [](const std::array<double, 3>& c) {
        const auto linear = [](double byte) {
            const double s = byte / 255;
            return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
        };
        return 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]) + 0.05;
    };
    return std::max(light(a), light(b)) / std::min(light(a), light(b));
}

// The colour that most pixels of a part have.
std::array<double, 3> main_colour(const Picture& picture, const Rectangle& part) {
    std::map<std::array<double, 3>, int> counts;
    for (int y = part.y; y < part.y + part.height; ++y)
        for (int x = part.x; x < part.x + part.width; ++x) {
            const std::uint8_t* p = picture.pixel(x, y);
            ++counts[{1.0 * p[0], 1.0 * p[1], 1.0 * p[2]}];
        }
    return std::max_element(counts.begin(), counts.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
}

TEST(Overlay, WordsOnPlatesReadOverAnyGrain) {
    EXPECT_NEAR(wcag_contrast({0, 0, 0}, {255, 255, 255}), 21, 1e-9);
    for (const FilmLook::Style style : {FilmLook::Style::flat, FilmLook::Style::dark})
        for (const Colour& grain : {Colour{0, 0, 0}, Colour{1, 1, 1}}) {
            FilmedScene scene = wedge();
            scene.film.look = FilmLook::of(style);
            scene.film.background = default_background(style);
            scene.film.exaggerate = 2;  // the exaggeration is written in the accent's colour
            scene.colours[0] = grain;
            scene.film.words = WordPlace::plates;
            const Palette palette = make_palette(scene.film.background);
            // The time is always at the upper end of the second gutter.
            Rectangle clock = plan_layout(scene).second;
            clock.height /= 5;
            Renderer renderer(scene, 1);
            const auto plate = main_colour(renderer.draw(frame_of({{{0, 0, 0.08}, 0.3, 0}}), ""), clock);
            for (const Colour& ink : {palette.ink, palette.faint_ink, palette.accent})
                EXPECT_GE(wcag_contrast(plate, {255 * ink.red, 255 * ink.green, 255 * ink.blue}), 4.5);
        }
}

TEST(Overlay, PlatesLeaveTheRestOfThePicture) {
    FilmedScene scene = wedge();
    scene.film.camera.zoom = 3;
    const PictureLayout layout = plan_layout(scene);
    EXPECT_TRUE(layout.plates);
    EXPECT_EQ(layout.port.width, scene.film.width);
    const Shot frame =
        frame_of({{{0, 0, 0.06}, 0.02, 0}, {{0, 0.04, 0.09}, 0.03, 1}, {{0, -0.04, 0.05}, 0.03, 1}});
    Renderer renderer(scene, 1);
    const Picture first = renderer.draw(frame, "caption");
    EXPECT_EQ(first.rgba, renderer.draw(frame, "caption").rgba);
    scene.film.words = WordPlace::none;
    const Picture bare = Renderer(scene, 1).draw(frame, "caption");
    int changed_pixels = 0;
    for (int y = 0; y < first.height; ++y)
        for (int x = 0; x < first.width; ++x) {
            const bool beside = x >= layout.first.width && x < layout.second.x;
            if (beside) {
                ASSERT_EQ(difference(first, bare, x, y), 0) << x << ", " << y;
            }
            changed_pixels += difference(first, bare, x, y) > 30;
        }
    EXPECT_GT(changed_pixels, 5000);
    scene.film.words = WordPlace::gutters;
    EXPECT_FALSE(plan_layout(scene).plates);
    scene = wedge();
    scene.film.camera.azimuth = 70;
    EXPECT_FALSE(plan_layout(scene).plates);  // only the container is framed
}

// All words and marks are asked for at once. Those without room are left out and named, and the others are
// whole.
TEST(Pictures, NoWordIsCutOff) {
    for (const auto& [width, height] : {std::pair{1920, 1080},
                                        {1080, 1920},
                                        {1080, 1350},
                                        {640, 360},
                                        {480, 480},
                                        {360, 640},
                                        {100, 100},
                                        {240, 180},
                                        {320, 240},
                                        {400, 1600},
                                        {300, 900},
                                        {640, 200},
                                        {1080, 1080},
                                        {1200, 1000}}) {
        FilmedScene scene = wedge(width, height);
        scene.film.title = "A title with an extraordinarilylongwordinitthatnogutterholds";
        scene.run.duration = 1;
        scene.film.axes = true;
        scene.film.shows.colour = {GrainValue::speed, ColourMap::viridis, {0, 0.3}, false, "cm/s", 5};
        scene.film.shows.arrows = {10, 0.1, true};
        scene.film.shows.trails = {{1}, {}, 0.1};
        scene.film.shows.force_chains = true;
        scene.film.shows.highlighted = {0};
        scene.film.shows.text = "mixing {lacey}";
        scene.film.shows.live_words = {{"mixing ", "lacey", "", 1}, {"", "", "", 1}};
        scene.film.shows.plots = {{"lacey", "mixing", std::nullopt},
                                  {"kinetic", "kinetic energy", std::nullopt}};
        const auto table =
            std::make_shared<MeasureTable>(std::vector<std::string>{"time_s", "lacey", "kinetic"});
        for (int row = 0; row < 40; ++row) table->add({0.02 * row, 0.3 + 0.01 * row, 0.001 * row});
        Shot frame = frame_of({{{0, 0, 0.08}, 0.01, 0}});
        frame.measures = table;
        frame.measure_rows = 40;
        const PictureLayout layout = plan_layout(scene);
        Renderer renderer(scene, 1);
        const Picture& picture = renderer.draw(frame, "slow motion, 1/10 speed");
        const auto blank = [&](const Rectangle& line) {
            for (int y = line.y; y < line.y + line.height; ++y)
                for (int x = line.x; x < line.x + line.width; ++x)
                    if (picture.pixel(x, y)[0] < 250) return false;
            return true;
        };
        for (const Rectangle& r : {layout.first, layout.second}) {
            EXPECT_TRUE(blank({r.x, r.y, r.width, 1})) << width << "x" << height << " upper";
            EXPECT_TRUE(blank({r.x, r.y + r.height - 1, r.width, 1})) << width << "x" << height << " lower";
            EXPECT_TRUE(blank({r.x, r.y, 1, r.height})) << width << "x" << height << " left";
            EXPECT_TRUE(blank({r.x + r.width - 1, r.y, 1, r.height})) << width << "x" << height << " right";
        }
        if (width == 1920) {
            EXPECT_EQ(layout.left_out, std::vector<std::string>());
        }
        if (width * height < 240 * 200) {
            EXPECT_EQ(layout.left_out, std::vector<std::string>{"words"});
        }
        EXPECT_GT(layout.port.height, 0.14 * height);
    }
}

TEST(Pictures, GuttersAndPortTileThePicture) {
    for (const auto& [width, height] :
         {std::pair{1920, 1080}, {320, 240}, {360, 1080}, {1080, 1080}, {641, 361}}) {
        const PictureLayout layout = plan_layout(wedge(width, height));
        const auto area = [](const Rectangle& r) { return r.width * r.height; };
        EXPECT_EQ(area(layout.first) + area(layout.second) + area(layout.port), width * height);
        EXPECT_GT(area(layout.port), 0.33 * width * height);
    }
}

TEST(Pictures, BackgroundHasNoSeamAndIsOpaque) {
    for (const Colour& background : {Colour{1, 1, 1}, Colour{0.07, 0.08, 0.1}, Colour{0.5, 0.25, 0.75}}) {
        FilmedScene scene = wedge();
        scene.film.background = background;
        const Rectangle port = plan_layout(scene).port;
        Renderer renderer(scene, 1);
        const Picture& picture = renderer.draw(frame_of({{{0, 0, 0.1}, 0.02, 1}}), "");
        for (const int x : {0, port.x - 1, port.x, port.x + port.width - 1, port.x + port.width, 639}) {
            const double expected[3] = {background.red, background.green, background.blue};
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(picture.pixel(x, 359)[c], 255 * expected[c], 0.51);
        }
        for (std::size_t i = 3; i < picture.rgba.size(); i += 4) ASSERT_EQ(picture.rgba[i], 255);
    }
}

TEST(Overlay, LettersAreLargeEnough) {
    for (const int height : {240, 360, 1080, 2160}) {
        const TypeScale type = type_scale(wedge(height * 16 / 9, height).film);
        EXPECT_GE(type.main, std::max(10.0, 0.025 * height));
        EXPECT_GE(type.minor, std::max(10.0, 0.018 * height));
    }
}

TEST(Overlay, SettlingIsSaid) {
    Shot frame;
    frame.time = -0.2;
    EXPECT_EQ(playback_text(Film(), frame, "slow motion 1/10"), "settling, drive off; slow motion 1/10");
    EXPECT_EQ(playback_text(Film(), frame, ""), "settling, drive off");
    frame.time = 0;
    EXPECT_EQ(playback_text(Film(), frame, "slow motion 1/10"), "slow motion 1/10");
}

TEST(Overlay, AHairBeforeAPeriodIsThatPeriod) {
    FilmedScene scene = wedge();
    scene.film.word_kinds.cycle = scene.film.word_kinds.dial = true;
    const PictureLayout layout = plan_layout(scene);
    Renderer renderer(scene, 1);
    Shot frame = frame_of({});
    frame.time = 2;
    frame.cycles = 20;
    const Picture whole = renderer.draw(frame, "");
    const double hair = 1.0 / 4000;
    frame.cycles = 20 - hair;
    frame.phase = 1 - hair;
    expect_same(whole, renderer.draw(frame, ""), layout.second);
    frame.phase = 0.99;
    EXPECT_GT(changed(whole, renderer.draw(frame, ""), layout.second).count, 20);
}

TEST(Overlay, CycleAndPhaseAgree) {
    Shot frame;
    for (const double start : {0.0, 0.25})
        for (int n = 0; n < 4000; ++n) {
            frame.cycles = n / 1000.0;
            frame.phase = std::fmod(start + frame.cycles, 1);
            const ShownCycle shown = shown_cycle(frame);
            ASSERT_LT(fmt::format("{:.2f}", shown.phase), "1.00");
            // Both parts together give the frame's time since the start, except for rounding.
            const double since_start = shown.phase - start + (shown.phase < start - 1e-9 ? 1 : 0);
            ASSERT_NEAR(static_cast<double>(shown.cycle) + since_start, frame.cycles, 0.005 + 1e-9);
        }
}

// The row of the accent-coloured pixel farthest to the right in the gutter of numbers. It is the middle of
// the dot that shows the floor in its stroke.
double floor_dot_row(const FilmedScene& scene, const Picture& picture) {
    const Rectangle part = plan_layout(scene).second;
    const Colour accent = make_palette(scene.film.background).accent;
    for (int x = part.x + part.width - 1; x >= part.x; --x) {
        double sum = 0, count = 0;
        for (int y = part.y; y < part.y + part.height; ++y) {
            const std::uint8_t* p = picture.pixel(x, y);
            const double away = std::abs(p[0] - 255 * accent.red) + std::abs(p[1] - 255 * accent.green) +
                                std::abs(p[2] - 255 * accent.blue);
            if (away > 60) continue;
            sum += y;
            ++count;
        }
        if (count > 0) return sum / count;
    }
    return -1;
}

TEST(Overlay, TheDialShowsWhereTheFloorIs) {
    FilmedScene scene = wedge(1280, 720);
    scene.film.word_kinds.dial = true;
    scene.film.word_kinds.shaking = false;  // its arrow has the dial's colour
    const double a = scene.drive.amplitude, radius = 2.2 * plan_layout(scene).type.main;
    const auto row = [&](double phase, double offset) {
        Shot frame = frame_of({});
        frame.phase = phase;
        frame.floor().place = offset * scene.drive.direction;
        return floor_dot_row(scene, Renderer(scene, 1).draw(frame, ""));
    };
    scene.drive.ramp = 2;
    const double middle = row(0, 0);
    EXPECT_NEAR(row(0.25, a), middle - radius, 1);
    EXPECT_NEAR(row(0.75, -0.1 * a), middle + 0.1 * radius, 1);
    EXPECT_NEAR(row(0.25, 0.5 * a), middle - 0.5 * radius, 1);
    // Without a ramp the drive's phase gives the place in the stroke.
    scene.drive.ramp = 0;
    scene.drive.phase = 0.25;
    EXPECT_NEAR(row(0.25, 0), middle - radius, 1);
    EXPECT_NEAR(row(0.75, -2 * a), middle + radius, 1);
}

TEST(Overlay, NumbersReadWell) {
    EXPECT_EQ(length_text(0.005), "5 mm");
    EXPECT_EQ(length_text(0.00186), "1.86 mm");
    EXPECT_EQ(length_text(0.001), "1 mm");
    EXPECT_EQ(length_text(0.1), "10 cm");
    EXPECT_EQ(length_text(0.00025), "250 µm");
    EXPECT_EQ(length_text(2), "2 m");
    EXPECT_EQ(frequency_text(1500), "1.5 kHz");
    EXPECT_EQ(time_text(-0.35, 10), "t = −0.350 s");
    EXPECT_EQ(time_text(-0.0001, 10), "t = 0.000 s");
    EXPECT_EQ(time_text(0.0012345, 0.05), "t = 1.234 ms");
    EXPECT_EQ(diameter_text({SizeSpread::Kind::uniform, 0.004, 0.006, 0.005, 0}), "4–6 mm");
    EXPECT_DOUBLE_EQ(round_length(0.0199), 0.01);
    EXPECT_DOUBLE_EQ(round_length(0.021), 0.02);
    EXPECT_DOUBLE_EQ(round_length(0.7), 0.5);
}

TEST(Context, ShadersThatDoNotCompileSayWhy) {
    const auto context = gl::make_context(gl::Provider::automatic, 1);
    const char* const fine = "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n";
    try {
        const gl::Program program(context->gl(), "broken", fine,
                                  "#version 330 core\nvoid main() { nonsense; }\n");
        FAIL() << "compiled";
    } catch (const RunError& error) {
        EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("fragment shader of 'broken'"),
                                                 testing::HasSubstr("nonsense")));
    }
}

}  // namespace
}  // namespace grainreel::test
