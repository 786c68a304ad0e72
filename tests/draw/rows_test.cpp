// Tests of rows of pixels that are laid over each other and darkened: many pixels at once against one at a
// time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "render/picture/container/ground.hpp"
#include "render/picture/spheres/layer.hpp"
#include "tests/instruction_sets.hpp"

namespace grainreel::test {
namespace {

// Pixels that are multiplied by their alpha; a third of them are clear.
std::vector<std::uint32_t> pixels(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> all(count);
    for (std::uint32_t& pixel : all)
        pixel = random() % 3 == 0
                    ? 0
                    : scaled(0xff000000u | static_cast<std::uint32_t>(random()), random() % 256);
    return all;
}

TEST(LayOver, IsOverForEachPixel) {
    for_each_instruction_set([](std::int64_t) {
        for (const std::uint32_t strength : {255u, 90u, 0u})
            for (std::size_t count = 0; count < 70; ++count) {
                const auto top = pixels(count + 1, 1), below = pixels(count + 1, 2);
                std::vector<std::uint32_t> expected = below, laid = below;
                for (std::size_t i = 0; i < count; ++i)
                    expected[i] = over(scaled(top[i], strength), below[i]);
                lay_over(laid.data(), top.data(), static_cast<int>(count), strength);
                ASSERT_EQ(laid, expected) << count << ' ' << strength;
            }
    });
}

TEST(DarkenRow, ScalesColoursAndLeavesAlpha) {
    for_each_instruction_set([](std::int64_t) {
        for (std::size_t count = 0; count < 70; ++count) {
            const auto before = pixels(count + 1, 3);
            std::vector<std::uint8_t> shares(count + 1);
            for (std::size_t i = 0; i < count; ++i)
                shares[i] = static_cast<std::uint8_t>(i % 5 ? 37 * i : 255);
            std::vector<std::uint32_t> expected = before, dark = before;
            for (std::size_t i = 0; i < count; ++i)
                for (int shift = 0; shift < 24; shift += 8) {
                    const auto value = static_cast<std::uint32_t>(
                        std::lround((before[i] >> shift & 255u) * shares[i] / 255.0));
                    expected[i] = (expected[i] & ~(255u << shift)) | value << shift;
                }
            darken_row(dark.data(), shares.data(), static_cast<int>(count));
            ASSERT_EQ(dark, expected) << count;
        }
    });
}

constexpr int kSide = 12;

// The strength of the map at a place, interpolated along both axes; 0 beside the map.
double strength_at(const std::vector<float>& cells, double u, double v) {
    if (!(u > 0 && v > 0 && u < kSide - 1 && v < kSide - 1)) return 0;
    const int i = static_cast<int>(u), j = static_cast<int>(v);
    const auto cell = [&](int x, int y) {
        return static_cast<double>(cells[static_cast<std::size_t>(y * kSide + x)]);
    };
    const double x = u - i, y = v - j;
    return (cell(i, j) * (1 - x) + cell(i + 1, j) * x) * (1 - y) +
           (cell(i, j + 1) * (1 - x) + cell(i + 1, j + 1) * x) * y;
}

struct Shaded {
    std::vector<float> cells, across;
    std::vector<std::uint32_t> before, after;
    MapWalk walk;
};
constexpr float kAll = 0.8f;

Shaded shaded(int count, unsigned seed) {
    std::mt19937 random(seed);
    const auto between = [&](double a, double b) {
        return static_cast<float>(a + (b - a) * static_cast<double>(random()) / 4294967296.0);
    };
    Shaded s;
    s.cells.assign(kSide * kSide, 0);
    for (int j = 1; j < kSide - 1; ++j)
        for (int i = 1; i < kSide - 1; ++i)
            s.cells[static_cast<std::size_t>(j * kSide + i)] = between(0, 255);
    // The walk goes from one side of the map across it to the other side; on some walks the horizon comes
    // first.
    const Eigen::Vector3f from(-3, between(0, kSide), 1), to(kSide + 3, between(0, kSide), 1);
    const float near = between(0.5, 2), far = seed % 3 == 0 ? -0.2f : between(0.5, 2);
    const float steps = static_cast<float>(std::max(count - 1, 1));
    s.walk = {near * from, (far * to - near * from) / steps};
    s.before.assign(static_cast<std::size_t>(count) + 1, 0xffffffffu);
    for (int x = 0; x < count; ++x) s.across.push_back(between(0.5, 1));
    s.after = s.before;
    shade_row({s.cells.data(), kSide}, s.walk, s.across.data(), kAll, s.after.data(), count);
    return s;
}

TEST(ShadeRow, DarkensByWhatTheMapSays) {
    for_each_instruction_set([](std::int64_t) {
        for (int count = 1; count < 80; ++count) {
            const Shaded s = shaded(count, static_cast<unsigned>(count));
            for (int x = 0; x < count; ++x) {
                const auto i = static_cast<std::size_t>(x);
                const Eigen::Vector3d at = s.walk.first.cast<double>() + x * s.walk.step.cast<double>();
                if (std::abs(at.z()) < 1e-3) continue;
                const double dark =
                    strength_at(s.cells, at.x() / at.z(), at.y() / at.z()) * s.across[i] * kAll;
                // Black of that strength lies over white; one level is allowed for the rounding of both.
                EXPECT_NEAR(s.after[i] & 0xff, 255 - dark, 1.1) << count << ' ' << x;
                EXPECT_EQ(s.after[i] >> 24, 0xffu);
            }
            EXPECT_EQ(s.after.back(), 0xffffffffu) << "beyond the row";
        }
    });
}

}  // namespace
}  // namespace grainreel::test
