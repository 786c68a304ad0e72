// Tests of the contact sheet, a picture with tiles from the whole film.
#include "render/picture/panels/contact_sheet.hpp"

#include <gmock/gmock.h>

#include "tests/film/film_fixture.hpp"
#include "tests/film/film_reading.hpp"

namespace grainreel::test {
namespace {

constexpr int gap = 16;

Film film_of(int columns, int rows, int width, int height) {
    Film film;
    film.width = width;
    film.height = height;
    film.sheet = {columns, rows};
    return film;
}

// The sheet of a film whose frame k has the grey k / 2 (so that 512 frames can be told apart in pairs).
Picture sheet_of(const Film& film, int frames) {
    ContactSheet sheet(film);
    Picture last;
    for (int k = 0; k < frames; ++k) {
        last = flat(film.width, film.height, k / 2, k / 2, k / 2);
        sheet.add(last, 0.01 * k);
    }
    return sheet.draw(last);
}

// The greys in the middles of the tiles, row by row.
std::vector<int> greys(const Picture& page, const Film& film) {
    const int width = (page.width - gap) / film.sheet[0], height = (page.height - gap) / film.sheet[1];
    std::vector<int> result;
    for (int row = 0; row < film.sheet[1]; ++row)
        for (int column = 0; column < film.sheet[0]; ++column)
            result.push_back(
                page.pixel(gap + column * width + width / 2, gap + row * height + height / 3)[0]);
    return result;
}

TEST(ContactSheet, FramesAreSpreadEvenlyFromTheFirstToTheLast) {
    const Film film = film_of(4, 3, 160, 96);
    for (const int frames : {12, 45, 96, 97, 200, 511}) {
        const std::vector<int> found = greys(sheet_of(film, frames), film);
        ASSERT_EQ(found.size(), 12u);
        const double spacing = (frames - 1) / 11.0;
        for (int i = 0; i < 12; ++i)
            // The tolerance is an eighth of the spacing, half a frame of rounding, and one for greys that
            // come in pairs.
            EXPECT_NEAR(2 * found[static_cast<std::size_t>(i)], i * spacing, spacing / 8 + 1.5)
                << frames << ' ' << i;
        EXPECT_EQ(found.back(), (frames - 1) / 2);
    }
}

// The film is ten times slower at both ends: three quarters of the frames show a twelfth of the time.
TEST(ContactSheet, TilesAreSpreadOverTheTimeThatTheFilmShows) {
    const Film film = film_of(4, 3, 160, 96);
    ContactSheet sheet(film);
    Picture last;
    const auto add = [&](double time) {
        const int grey = static_cast<int>(20 * time + 0.5);  // ten seconds give the grey 200
        last = flat(film.width, film.height, grey, grey, grey);
        sheet.add(last, time);
        sheet.add(last, time);  // where two segments meet, one moment comes twice
    };
    for (int k = 0; k < 120; ++k) add(0.4 * k / 120);
    for (int k = 0; k < 110; ++k) add(0.4 + 9.2 * k / 110);
    for (int k = 0; k <= 120; ++k) add(9.6 + 0.4 * k / 120);
    const std::vector<int> found = greys(sheet.draw(last), film);
    for (int i = 0; i < 12; ++i)
        EXPECT_NEAR(found[static_cast<std::size_t>(i)], 200 * i / 11.0, 200 / 11.0 / 8 + 1.5) << i;
}

TEST(ContactSheet, NoTimeStandsTwice) {
    const Film film = film_of(3, 2, 160, 96);
    ContactSheet sheet(film);
    Picture last;
    for (const int grey : {10, 10, 20, 20, 30, 30, 30}) {
        last = flat(film.width, film.height, grey, grey, grey);
        sheet.add(last, 0.1 * grey);
    }
    EXPECT_EQ(greys(sheet.draw(last), film), (std::vector<int>{10, 20, 30, 255, 255, 255}));
}

TEST(ContactSheet, FewerFramesThanTilesLeaveTheRestEmpty) {
    const Film film = film_of(3, 2, 160, 96);
    const std::vector<int> found = greys(sheet_of(film, 4), film);
    EXPECT_EQ(found, (std::vector<int>{0, 0, 1, 1, 255, 255}));
}

TEST(ContactSheet, IsNoWiderThan1920PixelsAndKeepsTheShapeOfItsFrames) {
    const Picture page = sheet_of(film_of(4, 3, 1920, 1080), 12);
    EXPECT_LE(page.width, 1920);
    EXPECT_GT(page.width, 1880);
    const double tile = (page.width - 5.0 * gap) / 4;
    EXPECT_GT(page.height, 3 * tile * 9 / 16);
    EXPECT_LT(page.height, 3 * tile * 9 / 16 + 4 * gap + 3 * 45);
}

// There is something written below each tile, and in no other gap.
TEST(ContactSheet, EveryTileHasItsTime) {
    const Film film = film_of(4, 3, 480, 270);
    const Picture page = sheet_of(film, 60);
    const int width = (page.width - gap) / 4, height = (page.height - gap) / 3;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) {
            const int tile_bottom = gap + row * height + 259;
            int dark = 0;
            for (int y = tile_bottom + 2; y < gap + (row + 1) * height - gap; ++y)
                for (int x = gap + column * width; x < (column + 1) * width; ++x)
                    if (page.pixel(x, y)[0] < 100) ++dark;
            EXPECT_GT(dark, 40) << row << ' ' << column;
        }
}

}  // namespace
}  // namespace grainreel::test
