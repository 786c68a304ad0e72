// Tests of the conversion of pictures to Y'CbCr by BT.709.
#include "render/film/codec/bt709.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/film/film_fixture.hpp"
#include "tests/film/film_reading.hpp"
#include "tests/instruction_sets.hpp"

namespace grainreel::test {
namespace {

struct Converted {
    std::vector<std::uint8_t> y, cb, cr;
    bool operator==(const Converted&) const = default;
};

// Converts a picture into rows that are `more` longer than the picture; the rest of each row must stay as it
// is.
Converted converted(const Picture& picture, int more = 0) {
    const int width = picture.width + more, half = picture.width / 2 + more;
    Converted out{std::vector<std::uint8_t>(static_cast<std::size_t>(width * picture.height), 7),
                  std::vector<std::uint8_t>(static_cast<std::size_t>(half * picture.height / 2), 7),
                  {}};
    out.cr = out.cb;
    to_bt709(picture, {out.y.data(), out.cb.data(), out.cr.data(), width, half, half});
    return out;
}

// The formula for colours that are means of two rows and three columns, where the middle column counts twice.
Code chroma_of(const Picture& picture, int x, int y) {
    std::array<double, 3> mean{};
    for (int row = 0; row < 2; ++row)
        for (int column = -1; column < 2; ++column) {
            const std::uint8_t* p = picture.pixel(std::max(2 * x + column, 0), 2 * y + row);
            for (std::size_t c = 0; c < 3; ++c) mean[c] += p[c] * (column == 0 ? 2 : 1) / 8.0;
        }
    return bt709_code(mean[0], mean[1], mean[2]);
}

void expect_codes(const Picture& picture, const Converted& codes, int more) {
    constexpr double kRounded = 0.51;
    const int width = picture.width, half = width / 2;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::uint8_t* p = picture.pixel(x, y);
            ASSERT_NEAR(codes.y[static_cast<std::size_t>(y * (width + more) + x)],
                        bt709_code(p[0], p[1], p[2])[0], kRounded)
                << x << ' ' << y;
        }
    for (int y = 0; y < picture.height / 2; ++y)
        for (int x = 0; x < half; ++x) {
            const Code code = chroma_of(picture, x, y);
            const auto at = static_cast<std::size_t>(y * (half + more) + x);
            ASSERT_NEAR(codes.cb[at], code[1], kRounded) << x << ' ' << y;
            ASSERT_NEAR(codes.cr[at], code[2], kRounded) << x << ' ' << y;
        }
}

// All widths around those of registers are tested, so that every column is once the first and once the last
// in a register.
TEST(Bt709, CodesAreTheFormulasRounded) {
    for (int width = 2; width <= 100; width += 2) {
        const Picture picture = noise(width, 6, static_cast<unsigned>(width));
        expect_codes(picture, converted(picture), 0);
    }
}

TEST(Bt709, LeavesTheRestOfLongerRowsAlone) {
    const Picture picture = noise(34, 4, 1);
    const Converted codes = converted(picture, 3);
    expect_codes(picture, codes, 3);
    for (int y = 0; y < 4; ++y)
        for (int x = 34; x < 37; ++x) EXPECT_EQ(codes.y[static_cast<std::size_t>(y * 37 + x)], 7);
    for (int y = 0; y < 2; ++y)
        for (int x = 17; x < 20; ++x) EXPECT_EQ(codes.cb[static_cast<std::size_t>(y * 20 + x)], 7);
}

// Parts of all places and sizes give the same codes as if the whole picture had been converted, and nothing
// far from the part changes.
TEST(Bt709, APartsCodesAreThoseOfTheWholePicture) {
    constexpr int width = 90, height = 8;
    const Picture before = noise(width, height, 3);
    const Converted old_codes = converted(before);
    for (int x = 0; x < 40; x += 3)
        for (const int across : {1, 2, 7, 34, 50}) {
            const Rectangle part{x, x % 5, across, 3};
            Picture after = before;
            for (int row = part.y; row < part.y + part.height; ++row)
                std::copy_n(noise(width, height, 4).pixel(part.x, row), 4 * part.width,
                            after.pixel(part.x, row));
            Converted codes = old_codes;
            to_bt709(after, part,
                     {codes.y.data(), codes.cb.data(), codes.cr.data(), width, width / 2, width / 2});
            EXPECT_EQ(codes, converted(after)) << x << ' ' << across;
        }
}

TEST(Bt709, EveryInstructionSetGivesTheSameBits) {
    const Picture picture = noise(150, 10, 2);
    const Converted best = converted(picture);
    for_each_instruction_set([&](std::int64_t) { EXPECT_EQ(converted(picture), best); });
}

}  // namespace
}  // namespace grainreel::test
