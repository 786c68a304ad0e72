// Tests of PNG files: pixels, alpha, text and failed writes.
#include "render/film/codec/png.hpp"

#include <gmock/gmock.h>

#include "engine/base/error.hpp"
#include "tests/film/film_fixture.hpp"
#include "tests/film/film_reading.hpp"
#include "tests/support/tells.hpp"

namespace grainreel::test {
namespace {

using PngTest = FilmTest;

TEST_F(PngTest, ComesBackBitForBitWithItsText) {
    for (const Picture& picture : {ball(33, 21, 5), noise(40, 30, 1), flat(1, 1, 1, 2, 3)}) {
        const std::filesystem::path path = folder / "picture.png";
        write_png(path, picture, {{"Title", "Γ = 3, große und kleine Körner"}, {"Time", "0.125 s"}});
        const PngFile png = read_png(path);
        EXPECT_EQ(png.channels, 3);
        EXPECT_TRUE(png.srgb);
        EXPECT_EQ(png.texts.at("Title"), "Γ = 3, große und kleine Körner");
        EXPECT_EQ(png.texts.at("Time"), "0.125 s");
        EXPECT_EQ(png.text_kinds.at("Title"), 1);  // iTXt
        ASSERT_EQ(png.picture.width, picture.width);
        ASSERT_EQ(png.picture.height, picture.height);
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x)
                for (int c = 0; c < 3; ++c) ASSERT_EQ(png.picture.pixel(x, y)[c], picture.pixel(x, y)[c]);
        EXPECT_FALSE(std::filesystem::exists(path.string() + ".part"));
    }
}

TEST_F(PngTest, AlphaIsKeptWhenAskedFor) {
    const Picture picture = noise(37, 23, 4);
    write_png(folder / "picture.png", picture, {}, true);
    const PngFile png = read_png(folder / "picture.png");
    EXPECT_EQ(png.channels, 4);
    EXPECT_TRUE(png.picture.rgba == picture.rgba);
}

TEST_F(PngTest, AFailedWriteNamesFileAndReasonAndKeepsTheOldPicture) {
    const std::filesystem::path path = folder / "picture.png";
    write_png(path, flat(8, 8, 1, 2, 3), {});
    try {
        const FileSizeLimit limit(1024);
        write_png(path, noise(200, 200, 1), {});
        FAIL() << "no error";
    } catch (const RunError& error) {
        EXPECT_EQ(error.what(), path.string() + ": cannot write the picture: File too large");
    }
    EXPECT_EQ(read_png(path).picture.width, 8);
    EXPECT_FALSE(std::filesystem::exists(path.string() + ".part"));
}

TEST_F(PngTest, AFolderThatIsNotThereIsARunError) {
    try {
        write_png(folder / "nowhere" / "picture.png", flat(8, 8, 0, 0, 0), {});
        FAIL() << "no error";
    } catch (const RunError& error) {
        EXPECT_THAT(error.what(), tells({"cannot write", "picture", "No such file"}));
    }
}

}  // namespace
}  // namespace grainreel::test
