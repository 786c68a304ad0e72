// Tests of films with a limit on their size: they fit, and digits in them can be read.
#include "render/film/codec/spooled_films.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/scene/text/units.hpp"
#include "render/film/codec/film_writer.hpp"
#include "render/scene/film.hpp"
#include "render/scene/shown_values.hpp"
#include "tests/film/film_fixture.hpp"
#include "tests/film/film_reading.hpp"
#include "tests/support/tells.hpp"

namespace grainreel::test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr int frames = 50, wide = 256, high = 144;

// A digit has three by five dots, row after row from the top.
constexpr std::array<std::array<int, 5>, 10> font{{{7, 5, 5, 5, 7},
                                                   {2, 6, 2, 2, 7},
                                                   {7, 1, 7, 4, 7},
                                                   {7, 1, 3, 1, 7},
                                                   {5, 5, 7, 1, 1},
                                                   {7, 4, 7, 1, 7},
                                                   {7, 4, 7, 5, 7},
                                                   {7, 1, 1, 2, 2},
                                                   {7, 5, 7, 5, 7},
                                                   {7, 5, 7, 1, 7}}};
constexpr int dot = 2, digit_width = 4 * dot, digit_height = 5 * dot, margin = 4;  // pixels
constexpr int ink = 90, paper = 235;  // the same as small words on a frame
constexpr int places = 4;             // digits in the number shown

bool inked(int digit, int x, int y) {
    return x < 3 * dot && (font[digit][y / dot] >> (2 - x / dot) & 1) != 0;
}

int digit_of(int number, int place) {
    const int shown = 7 * number % 10'000;
    return place == 0   ? shown / 1000
           : place == 1 ? shown / 100 % 10
           : place == 2 ? shown / 10 % 10
                        : shown % 10;
}

// Discs move over the picture. The frame's number is in a corner without discs, as words stand beside grains.
Picture numbered(int width, int height, int number) {
    Picture picture = discs(width, height, number);
    for (int y = 0; y < digit_height + 2 * margin; ++y)
        for (int x = 0; x < places * digit_width + 2 * margin; ++x) {
            const int place = (x - margin) / digit_width, dx = (x - margin) % digit_width, dy = y - margin;
            const bool inside = x >= margin && place < places && dy >= 0 && dy < digit_height;
            const bool on = inside && inked(digit_of(number, place), dx, dy);
            for (int channel = 0; channel < 3; ++channel)
                picture.pixel(x, y)[channel] = static_cast<std::uint8_t>(on ? ink : paper);
        }
    return picture;
}

// The digit that a reader takes this one for: the one with the smallest squared difference of greys.
int read_digit(const Picture& picture, int place) {
    double best = std::numeric_limits<double>::infinity();
    int found = -1;
    for (int digit = 0; digit < 10; ++digit) {
        double sum = 0;
        for (int y = 0; y < digit_height; ++y)
            for (int x = 0; x < digit_width; ++x) {
                const double seen = picture.pixel(margin + place * digit_width + x, margin + y)[1];
                sum += std::pow(seen - (inked(digit, x, y) ? ink : paper), 2);
            }
        if (sum >= best) continue;
        best = sum;
        found = digit;
    }
    return found;
}

int false_digits(const FilmFile& film) {
    int wrong = 0;
    for (int i = 0; i < static_cast<int>(film.frames.size()); ++i) {
        const Picture picture = to_rgb(film.frames[static_cast<std::size_t>(i)]);
        for (int place = 0; place < places; ++place)
            wrong += read_digit(picture, place) != digit_of(i, place) ? 1 : 0;
    }
    return wrong;
}

class CappedFilmTest : public FilmTest, public ::testing::WithParamInterface<FilmFormat> {
  protected:
    std::filesystem::path path() const { return folder / film_file_name(GetParam()); }
    std::int64_t size() const { return static_cast<std::int64_t>(std::filesystem::file_size(path())); }
    std::string make(std::optional<std::int64_t> cap, int width = wide, int height = high,
                     int quality = 18) const {
        FilmedScene scene = small_scene(width, height);
        scene.film.format = GetParam();
        scene.film.rate = 25;
        scene.film.quality = quality;
        scene.film.max_size = cap;
        const auto writer = make_film_writer(scene, {folder.path(), false, 2});
        for (int i = 0; i < frames; ++i) writer->add(numbered(width, height, i));
        writer->finish();
        return writer->description();
    }
    std::int64_t size_at(int quality) const {
        make({}, wide, high, quality);
        return size();
    }
};

INSTANTIATE_TEST_SUITE_P(Formats, CappedFilmTest, ::testing::Values(FilmFormat::mp4, FilmFormat::webm),
                         [](const auto& format) { return word_of(format.param, film_format_words); });

TEST_P(CappedFilmTest, FillsItsCapFromBelowAndItsDigitsReadRight) {
    const auto full = static_cast<double>(size_at(18)), floor = static_cast<double>(size_at(least_legible));
    for (const double wanted : {std::sqrt(full * floor), 1.01 * floor}) {
        const auto cap = static_cast<std::int64_t>(wanted);
        EXPECT_THAT(make(cap), HasSubstr("under the cap of"));
        EXPECT_LE(size(), cap);
        EXPECT_GE(static_cast<double>(size()), 0.9 * static_cast<double>(cap));
        const FilmFile film = read_film(path());
        ASSERT_THAT(film.frames, SizeIs(frames));
        EXPECT_EQ(false_digits(film), 0) << cap;
        EXPECT_FALSE(std::filesystem::exists(folder / "movie.work"));
    }
}

TEST_P(CappedFilmTest, ACapAtWhichDigitsWouldReadWrongIsAClearErrorAndKeepsTheFilm) {
    const std::int64_t full = size_at(18), floor = size_at(least_legible);
    for (const std::int64_t cap : {floor - 1, full / 7}) {
        try {
            make(cap);
            ADD_FAILURE() << "no error at " << cap << ", false digits: " << false_digits(read_film(path()));
        } catch (const RunError& error) {
            EXPECT_THAT(error.what(),
                        HasSubstr(fmt::format("a cap of {} is too small for this film: below {} small digits",
                                              data_size_text(static_cast<double>(cap)),
                                              data_size_text(static_cast<double>(floor)))));
            EXPECT_THAT(error.what(), HasSubstr("What fits: "));
            EXPECT_THAT(error.what(), tells({"--max-size", "whole film"}));
        }
        EXPECT_EQ(size(), full);
        EXPECT_THAT(read_film(path()).frames, SizeIs(frames));
        EXPECT_FALSE(std::filesystem::exists(folder / "movie.work"));
    }
}

// Above the least legible quality, films with which the cap is measured are no worse.
TEST_P(CappedFilmTest, AtTheLeastLegibleQualityDigitsReadRight) {
    size_at(least_legible);
    EXPECT_EQ(false_digits(read_film(path())), 0);
    size_at(40);
    EXPECT_GT(false_digits(read_film(path())), 0);  // otherwise the test would see nothing
}

TEST_P(CappedFilmTest, AFilmThatFitsIsLeftAtItsQuality) {
    EXPECT_THAT(make(1'000'000'000), tells({"below the cap", "1 GB"}));
    const std::int64_t full = size();
    make(full);
    EXPECT_EQ(size(), full);
    EXPECT_FALSE(std::filesystem::exists(folder / "movie.work"));
}

TEST_P(CappedFilmTest, OddSizesFitToo) {
    make({}, 161, 97);
    const std::int64_t cap = size() * 9 / 10;
    EXPECT_THAT(make(cap, 161, 97), HasSubstr("under the cap of"));
    EXPECT_LE(size(), cap);
    EXPECT_THAT(read_film(path()).frames, SizeIs(frames));
}

TEST_P(CappedFilmTest, TheSamePicturesGiveTheSameBytes) {
    make({}, 160, 96);
    const std::int64_t cap = size() * 9 / 10;
    const auto bytes = [&] {
        EXPECT_THAT(make(cap, 160, 96), HasSubstr("under the cap of"));
        return std::filesystem::file_size(path());
    };
    const auto first = bytes();
    EXPECT_EQ(first, bytes());
}

// ---- GIF ----

class CappedGif : public FilmTest {
  protected:
    std::filesystem::path path() const { return folder / "movie.gif"; }
    std::int64_t size() const { return static_cast<std::int64_t>(std::filesystem::file_size(path())); }
    std::string make(std::optional<std::int64_t> cap) const {
        FilmedScene scene = small_scene(160, 96);
        scene.film.format = FilmFormat::gif;
        scene.film.rate = 25;
        scene.film.max_size = cap;
        const auto writer = make_film_writer(scene, {folder.path(), false, 1});
        for (int i = 0; i < 25; ++i) writer->add(numbered(160, 96, i));
        writer->finish();
        return writer->description();
    }
};

TEST_F(CappedGif, GetsFewerColoursAndItsDigitsStayRight) {
    EXPECT_THAT(make({}), HasSubstr("256 colours, Bayer dither"));
    const std::int64_t full = size();
    EXPECT_THAT(make(full), HasSubstr("256 colours, Bayer dither"));
    EXPECT_THAT(make(full - 1), HasSubstr("128 colours, fine Bayer dither"));
    const std::int64_t less = size();
    EXPECT_LT(less, full);
    EXPECT_THAT(make(less - 1), HasSubstr("64 colours, no dither"));
    const std::int64_t least_but_one = size();
    EXPECT_THAT(make(least_but_one - 1), HasSubstr("32 colours, no dither"));
    EXPECT_LT(size(), least_but_one);
    const FilmFile film = read_film(path());
    ASSERT_THAT(film.pictures, SizeIs(25));
    for (int i = 0; i < 25; ++i)
        for (int place = 0; place < places; ++place)
            EXPECT_EQ(read_digit(film.pictures[static_cast<std::size_t>(i)], place), digit_of(i, place));
    EXPECT_FALSE(std::filesystem::exists(folder / "movie.work"));
}

TEST_F(CappedGif, ACapBelowTheFewestColoursIsAClearErrorAndKeepsTheFilm) {
    make({});
    const std::int64_t full = size();
    try {
        make(2000);
        FAIL() << "no error";
    } catch (const RunError& error) {
        EXPECT_THAT(error.what(), tells({"2 kB", "too small", "film"}));
        EXPECT_THAT(error.what(), HasSubstr("What fits: "));
    }
    EXPECT_EQ(size(), full);
    EXPECT_FALSE(std::filesystem::exists(folder / "movie.work"));
}

// scale = (0.9 share)^(1 / 1.4); the other way is to keep the share 0.9 share of the frames.
TEST(SmallerFilm, SaysWhichFilmWouldFit) {
    const int width = 2 * static_cast<int>(1280 * std::pow(0.45, 1 / 1.4) / 2);
    const int height = 2 * static_cast<int>(720 * std::pow(0.45, 1 / 1.4) / 2);
    EXPECT_THAT(smaller_film(1280, 720, 352, 0.5),
                ::testing::StartsWith(fmt::format("--size {}x{}, or 158 of its 352 frames", width, height)));
    EXPECT_THAT(smaller_film(1280, 720, 352, 0.1), ::testing::StartsWith("31 of its 352 frames"));
    EXPECT_THAT(smaller_film(1280, 720, 352, 0.001), ::testing::StartsWith("no smaller picture"));
}

}  // namespace
}  // namespace grainreel::test
