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

// Shows 3 s of a chequerboard of 24 x 18 fields. `bright` says which of them are, by their number and the
// time (s).
std::optional<double> watched_fields(const std::function<bool(int, double)>& bright) {
    FlashWatch watch(kRate);
    Picture picture(480, 270);
    for (int frame = 0; frame < 3 * kRate; ++frame) {
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x) {
                const int field = y * 18 / picture.height * 24 + x * 24 / picture.width;
                for (int c = 0; c < 3; ++c)
                    picture.pixel(x, y)[c] = grey(bright(field, frame / kRate) ? 0.5 : 0.2);
            }
        watch.add(picture);
    }
    return watch.too_much_at();
}

// WCAG exempts only fields smaller than 0.1 degrees. Here they have 1.25 degrees.
TEST(FlashWatch, FieldsThatExchangeTheirBrightnessFlash) {
    const auto odd = [](int field) { return (field % 24 + field / 24) % 2; };
    const auto turn = square(0, 1, 5);
    EXPECT_TRUE(watched_fields([&](int field, double t) { return odd(field) == (turn(t) > 0.5); }));
    EXPECT_TRUE(watched_fields([&](int field, double t) { return odd(field) && turn(t) > 0.5; }));
}

// Each field flashes twice a second, at a time of its own. At every moment some of them change.
TEST(FlashWatch, FieldsThatChangeSeldomEachAtItsOwnTimeAreNone) {
    const auto turn = square(0, 1, 2);
    EXPECT_FALSE(
        watched_fields([&](int field, double t) { return turn(t + (field * 7 % 30) / kRate) > 0.5; }));
}

}  // namespace
}  // namespace grainreel
