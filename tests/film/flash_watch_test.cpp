// Tests of the flash watch against the numbers of WCAG 2.2, success criterion 2.3.1.
#include "render/film/production/flash_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "render/picture/base/picture.hpp"

namespace grainreel {
namespace {

constexpr double kRate = 60;

std::uint8_t grey(double luminance) {
    return static_cast<std::uint8_t>(std::lround(255 * to_srgb(luminance)));
}

// Shows 3 s of a picture on mid-grey, of which the left `share` of the width has the luminance of each time
// (s).
std::optional<double> watched(double share, const std::function<double(double)>& luminance) {
    FlashWatch watch(kRate);
    Picture picture(480, 270);
    for (int frame = 0; frame < 3 * kRate; ++frame) {
        std::fill(picture.rgba.begin(), picture.rgba.end(), grey(0.2));
        const std::uint8_t level = grey(luminance(frame / kRate));
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < share * picture.width; ++x)
                for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = level;
        watch.add(picture);
    }
    return watch.too_much_at();
}

std::function<double(double)> square(double low, double high, double frequency) {
    return [=](double t) { return std::fmod(t * frequency + 1e-9, 1) < 0.5 ? low : high; };
}

TEST(FlashWatch, ThreeFlashesASecondAreAllowedAndFourAreNot) {
    EXPECT_FALSE(watched(1, square(0.2, 0.5, 3)));
    const auto at = watched(1, square(0.2, 0.5, 4));
    ASSERT_TRUE(at);
    EXPECT_NEAR(*at, 1, 0.02);  // the eighth change ends the fourth pair
}

TEST(FlashWatch, SmallChangesAndBrightOnesAreNone) {
    EXPECT_FALSE(watched(1, square(0.2, 0.29, 10)));
    EXPECT_TRUE(watched(1, square(0.2, 0.31, 10)));
    EXPECT_FALSE(watched(1, square(0.82, 1, 10)));
    EXPECT_TRUE(watched(1, square(0.78, 1, 10)));
}

TEST(FlashWatch, ASmallPartOfThePictureMayFlash) {
    EXPECT_FALSE(watched(1 / 24.0, square(0.2, 0.6, 10)));
    EXPECT_TRUE(watched(1 / 12.0, square(0.2, 0.6, 10)));  // a quarter of a third of the width
}

TEST(FlashWatch, ASlowRiseAndFallIsAsMuchAsASuddenOne) {
    const auto wave = [](double frequency) {
        return [=](double t) { return 0.4 + 0.2 * std::sin(2 * std::numbers::pi * frequency * t); };
    };
    EXPECT_FALSE(watched(1, wave(2.9)));
    EXPECT_TRUE(watched(1, wave(4)));
    EXPECT_FALSE(watched(1, [](double t) { return 0.1 + 0.3 * t; })) << "a rise alone is no flash";
}

// Shows 3 s of a chequerboard of 24 x 18 fields, whose bright and dark fields are exchanged ten times a
// second. Of each 24 dark fields 3 keep their luminance, so that the others are fewer than the bright ones.
TEST(FlashWatch, PlacesThatExchangeTheirBrightnessAreNone) {
    FlashWatch exchanged(kRate), together(kRate);
    for (int frame = 0; frame < 3 * kRate; ++frame) {
        const bool turn = square(0, 1, 5)(frame / kRate) > 0.5;
        Picture fields(480, 270), same(480, 270);
        for (int y = 0; y < fields.height; ++y)
            for (int x = 0; x < fields.width; ++x) {
                const int across = x * 24 / fields.width, down = y * 18 / fields.height;
                const bool odd = (across + down) % 2 == 1, keeps = odd && across % 8 == 0;
                for (int c = 0; c < 3; ++c) {
                    fields.pixel(x, y)[c] = grey(!keeps && odd == turn ? 0.5 : 0.2);
                    same.pixel(x, y)[c] = grey(!odd && turn ? 0.5 : 0.2);
                }
            }
        exchanged.add(fields);
        together.add(same);
    }
    EXPECT_FALSE(exchanged.too_much_at());
    EXPECT_TRUE(together.too_much_at()) << "half of all fields flash five times a second";
}

}  // namespace
}  // namespace grainreel
