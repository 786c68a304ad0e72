// Tests of the purposes of films, and of formats and sizes of their files.
#include "render/scene/purposes.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "engine/base/error.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/text/units.hpp"
#include "render/scene/film.hpp"
#include "render/scene/shown_values.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using test::tells_only;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string complaint(const std::string& text, const std::vector<std::string>& sets) {
    try {
        read_text(text, sets);
    } catch (const UserError& error) {
        return error.what();
    }
    return "no complaint";
}

TEST(Purposes, TheTableOfTheDocsIsThePrograms) {
    std::ifstream file(GRAINREEL_SOURCE "/docs/guide/films.md");
    std::ostringstream text;
    text << file.rdbuf();
    for (const Purpose& p : purposes()) {
        const std::string row =
            fmt::format("| `{}` | {}x{} | {} | {} | {} | {} | {} | {} |", p.name, p.width, p.height, p.rate,
                        word_of(p.format, film_format_words), p.quality, p.preset,
                        p.max_size ? data_size_text(static_cast<double>(*p.max_size)) : "none",
                        p.sheet[0] > 0 ? fmt::format("{}x{}", p.sheet[0], p.sheet[1]) : "none");
        EXPECT_THAT(text.str(), HasSubstr(row));
    }
}

TEST(Purposes, SetDefaultsAlone) {
    const Film plain = read_text(wedge_text, {"film.for=journal"}).film;
    EXPECT_EQ(plain.width, 1280);
    EXPECT_EQ(plain.height, 720);
    EXPECT_EQ(plain.rate, 25);
    EXPECT_EQ(plain.max_size, 10'000'000);
    EXPECT_EQ(plain.preset, "slow");
    const FilmedScene own = read_text(wedge_text + "[film]\nsize = \"640x360\"\nmax_size = \"none\"\n",
                                      {"film.for=journal", "film.rate=30", "film.quality=25"});
    EXPECT_EQ(own.film.width, 640);
    EXPECT_EQ(own.film.rate, 30);
    EXPECT_EQ(own.film.quality, 25);
    EXPECT_FALSE(own.film.max_size);
    EXPECT_THAT(own.notes, ElementsAre(HasSubstr("size 640x360 (1280x720), rate 30 (25)")));
}

// All values that a purpose gives can be set over a scene that has every key.
TEST(Purposes, AsAssignmentsTheyOverrideAScene) {
    const std::string all =
        wedge_text +
        "[film]\nsize = \"640x360\"\nrate = 60\nformat = \"webm\"\nquality = 40\npreset = "
        "\"ultrafast\"\nmax_size = \"1 GB\"\n";
    for (const Purpose& purpose : purposes()) {
        const Film film = read_text(all, assignments_of(purpose)).film;
        const Film expected = read_text(wedge_text, {std::string("film.for=") + purpose.name}).film;
        EXPECT_EQ(film.width, expected.width);
        EXPECT_EQ(film.rate, expected.rate);
        EXPECT_EQ(film.format, expected.format);
        EXPECT_EQ(film.quality, expected.quality);
        EXPECT_EQ(film.preset, expected.preset);
        EXPECT_EQ(film.max_size, expected.max_size);
        EXPECT_EQ(film.sheet, expected.sheet);
    }
}

TEST(FilmFile, SizesAreReadInTheirUnits) {
    EXPECT_EQ(parse_data_size("10MB"), 10'000'000);
    EXPECT_EQ(parse_data_size("10 MB"), 10'000'000);
    EXPECT_EQ(parse_data_size("1.5 GB"), 1'500'000'000);
    EXPECT_EQ(parse_data_size("250kB"), 250'000);
    EXPECT_EQ(parse_data_size("9.5 MiB"), 9'961'472);  // 9.5 x 1024^2
    EXPECT_EQ(parse_data_size("12 B"), 12);
    for (const char* wrong :
         {"", "10", "MB", "-3 MB", "10 Mb", "10 mb", "0 MB", "1e3 MB", "ten MB", "inf GB"})
        EXPECT_FALSE(parse_data_size(wrong)) << wrong;
}

// The possible rates are 100/n frames a second, n from 2: 30 is 3.33 away from 33.3 and 5 away from 25.
TEST(FilmFile, AGifGetsTheNearestRateThatItCanHave) {
    const std::vector<std::pair<double, double>> cases{
        {30, 100 / 3.0}, {25, 25},        {24, 25},   {50, 50}, {60, 50},
        {240, 50},       {15, 100 / 7.0}, {12, 12.5}, {1, 1},   {29, 25}};
    for (const auto& [wanted, given] : cases) {
        const FilmedScene scene =
            read_text(wedge_text, {"film.format=gif", fmt::format("film.rate={}", wanted)});
        EXPECT_NEAR(scene.film.rate, given, 1e-12) << wanted;
        EXPECT_EQ(scene.notes.empty(), wanted == given) << wanted;
    }
    const FilmedScene scene = read_text(wedge_text, {"film.format=gif"});
    EXPECT_THAT(make_plan(scene).warnings[0], tells({"33.33 frames/s", "30"}));
}

TEST(FilmFile, WhatDoesNotGoTogetherIsRefused) {
    EXPECT_THAT(complaint(wedge_text, {"film.max_size=10"}),
                tells_only({"--set film.max_size", "'max_size'", "kB, MB, GB", "\"10\"", "\"10 MB\""}));
    EXPECT_THAT(complaint(wedge_text, {"film.max_size=10 MB", "film.format=ffv1"}),
                tells_only({"--set film.max_size", "'max_size'", "mp4, webm and", "ffv1", "\"none\""}));
    EXPECT_EQ(read_text(wedge_text, {"film.max_size=3 MB", "film.format=gif"}).film.max_size, 3'000'000);
    EXPECT_THAT(
        complaint(wedge_text, {"film.transparent=true"}),
        tells_only({"--set film.transparent", "'transparent'", "png and ffv1", "mp4", "format = \"png\""}));
    EXPECT_THAT(complaint(wedge_text, {"film.format=avi"}), HasSubstr("must be \"mp4\" or \"webm\""));
    EXPECT_THAT(complaint(wedge_text, {"film.sheet=0x3"}), tells({"columns x rows", "1 to 12"}));
    EXPECT_THAT(complaint(wedge_text, {"film.for=fun"}), HasSubstr("\"journal\""));
    EXPECT_EQ(read_text(wedge_text, {"film.max_size=3 MB"}).film.quality, 18);
    EXPECT_EQ(read_text(wedge_text, {"film.max_size=3 MB", "film.quality=30"}).film.quality, 30);
}

}  // namespace
}  // namespace grainreel
