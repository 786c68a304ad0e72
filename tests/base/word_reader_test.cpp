// Tests of the reader of words and numbers in texts.
#include "engine/base/word_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grainreel {
namespace {

TEST(WordReader, NumbersComeOneByOneWithTheirLines) {
    WordReader words("1 -2.5e-1\r\n+3\t0.5d0\n\n nan 1e400 -1.#IND");
    for (const double number : {1.0, -0.25}) EXPECT_EQ(words.next_number(), number);
    EXPECT_EQ(words.line(), 1);
    EXPECT_EQ(words.next_number(), 3.0);
    EXPECT_EQ(words.line(), 2);
    EXPECT_EQ(words.next_number(), 0.5);
    EXPECT_TRUE(std::isnan(*words.next_number()));
    EXPECT_EQ(words.line(), 4);
    EXPECT_EQ(words.next_number(), INFINITY);
    EXPECT_TRUE(std::isnan(*words.next_number()));
    EXPECT_FALSE(words.has_word());
    EXPECT_EQ(words.next_number(), std::nullopt);
}

TEST(WordReader, AWordThatIsNoNumberStaysTheNext) {
    WordReader words(" 1 2,5 x");
    EXPECT_EQ(words.next_number(), 1.0);
    EXPECT_EQ(words.next_number(), std::nullopt);
    EXPECT_TRUE(words.has_word());
    EXPECT_EQ(words.next(), "2,5");
    EXPECT_EQ(words.next_number(), std::nullopt);
    EXPECT_EQ(words.next(), "x");
    EXPECT_TRUE(words.next().empty());
}

}  // namespace
}  // namespace grainreel
