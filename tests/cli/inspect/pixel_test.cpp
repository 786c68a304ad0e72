// Tests of which grain is at a pixel, against the picture in the run's film.
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/questions/asked_moment.hpp"
#include "render/film/answers/pictured_answer.hpp"
#include "render/film/sources/recorded_scene.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;

constexpr int kinds = 12;  // species, whose hues are 30 degrees apart
constexpr int width = 480, height = 360;
constexpr int shown_frame = 4;  // number in the film

std::string colour_of(int kind) {
    const auto channel = [&](double at) {
        const double k = std::fmod(at + kind * 12.0 / kinds, 12.0);
        return std::lround(255 * (0.9 - 0.75 * std::max(-1.0, std::min({k - 3, 9 - k, 1.0})) * 0.5 - 0.375));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", channel(0), channel(8), channel(4));
}

std::string scene_text() {
    std::string text = "title = \"Twelve colours\"\n";
    for (int kind = 0; kind < kinds; ++kind)
        text += fmt::format(
            "[[species]]\nname = \"kind {}\"\ncount = 12\ndiameter = \"{} mm\"\ndensity = \"2.5 g/cm3\"\n"
            "colour = \"{}\"\n",
            kind, 4 + kind % 3, colour_of(kind));
    return text + R"(
[contact]
restitution = 0.7
friction = 0.4
[container]
shape = "box"
width = "40 mm"
depth = "24 mm"
height = "60 mm"
[drive]
frequency = "20 Hz"
g_level = 3
[start]
settle_limit = "0.05 s"
[run]
duration = "0.04 s"
accuracy = "draft"
[film]
size = "480x360"
rate = 30
style = "flat"
[[film.plot]]
y = "centre_z"
[[film.segment]]
playback = 0.2
)";
}

struct Pixels {
    std::vector<std::uint8_t> rgb;
    const std::uint8_t* at(int x, int y) const {
        return rgb.data() + 3 * (static_cast<std::size_t>(y) * width + x);
    }
};

Pixels read_picture(const std::filesystem::path& file) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_file(&image, file.c_str())) << image.message;
    image.format = PNG_FORMAT_RGB;
    EXPECT_EQ(static_cast<int>(image.width), width);
    Pixels pixels{std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
    EXPECT_TRUE(png_image_finish_read(&image, nullptr, pixels.rgb.data(), 0, nullptr)) << image.message;
    return pixels;
}

// What a pixel shows, by its colour: a species, or -1 for the light background; none if it cannot be told.
std::optional<int> shown_by(const std::uint8_t* pixel) {
    const int most = std::max({pixel[0], pixel[1], pixel[2]}),
              least = std::min({pixel[0], pixel[1], pixel[2]});
    if (least > 235) return -1;
    if (most < 70 || most - least < 0.5 * most) return std::nullopt;
    const double spread = most - least;
    const double red = pixel[0], green = pixel[1], blue = pixel[2];
    double hue = most == pixel[0]   ? (green - blue) / spread
                 : most == pixel[1] ? 2 + (blue - red) / spread
                                    : 4 + (red - green) / spread;
    hue = std::fmod(hue + 6, 6) * kinds / 6;
    const double nearest = std::round(hue);
    if (std::abs(hue - nearest) > 0.25) return std::nullopt;
    return static_cast<int>(nearest) % kinds;
}

// The same, if the neighbours of the pixel show it too, so that no edge is near.
std::optional<int> shown_about(const Pixels& picture, int x, int y) {
    const std::optional<int> here = shown_by(picture.at(x, y));
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (shown_by(picture.at(x + dx, y + dy)) != here) return std::nullopt;
    return here;
}

class PixelOfTheFilm : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(PixelOfTheFilm, IsOfTheGrainThatThePictureShows) {
    const TemporaryFolder here;
    std::ofstream(here / "colours.toml") << scene_text();
    std::vector<std::string> words = {"movie", "colours.toml", "--out", "run", "--frames", "--no-report"};
    for (const std::string& set : GetParam()) words.insert(words.end(), {"--set", set});
    const Ended movie = run_program(words, {.folder = here.path()});
    ASSERT_EQ(movie.status, 0) << movie.err;
    const Pixels picture = read_picture(here / "run/frames" / fmt::format("{:06}.png", shown_frame));

    StoredRunRequest request;
    request.threads = 1;
    const FilmedRun filmed = open_filmed(here / "run", {}, request);
    const Snapshot snapshot = brought_back_snapshot(
        *filmed.run, find_moment(*filmed.run, {.frame = shown_frame}), [](double) { return true; });
    const PixelPicker picker(snapshot, filmed.scene, shown_frame / filmed.scene.film.rate);
    std::mt19937 random(11);
    std::uniform_int_distribution<int> across(2, width - 3), down(2, height - 3);
    int grains = 0, nothing = 0;
    for (int tries = 0; tries < 20000 && grains < 200; ++tries) {
        const int x = across(random), y = down(random);
        const std::optional<int> expected = shown_about(picture, x, y);
        if (!expected) continue;
        std::vector<std::vector<AnswerCell>> rows;
        try {
            rows = picker.at(x, y, false).tables[0].rows;
        } catch (const UserError&) {
            continue;  // there are words and their legend
        }
        const bool is_grain = !rows.empty() && std::holds_alternative<std::int64_t>(rows[0][0]);
        if (*expected < 0) {
            EXPECT_FALSE(is_grain) << x << ',' << y;
            ++nothing;
            continue;
        }
        ++grains;
        ASSERT_TRUE(is_grain) << x << ',' << y << " shows kind " << *expected;
        EXPECT_EQ(std::get<std::string>(rows[0][1]), fmt::format("kind {}", *expected)) << x << ',' << y;
    }
    EXPECT_EQ(grains, 200);
    EXPECT_GT(nothing, 50);
}

INSTANTIATE_TEST_SUITE_P(
    Cameras, PixelOfTheFilm,
    testing::Values(std::vector<std::string>{},
                    std::vector<std::string>{"film.camera.azimuth=35", "film.camera.elevation=25"},
                    std::vector<std::string>{"film.camera.field_of_view=50", "film.exaggerate=2"},
                    std::vector<std::string>{"film.cut.at=0", "film.camera.azimuth=30"},
                    std::vector<std::string>{"film.hide=[\"kind 3\", \"kind 7\"]",
                                             "film.camera.elevation=12"}));

}  // namespace
}  // namespace grainreel
