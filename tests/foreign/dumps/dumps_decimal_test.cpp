// Tests of numbers in texts against strtod, whose result is the nearest double.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

#include "engine/base/number_text.hpp"
#include "engine/files/foreign/bytes/decimal.hpp"

namespace grainreel {
namespace {

// Reads a number as readers do: the fast way if it takes the number, and otherwise the other way.
struct Read {
    bool taken = false, fast = false;
    double value = 0;
};
Read read_number(const std::string& word) {
    const std::string text = word + "\n        ";
    Read read;
    const char* const end = plain_decimal(text.c_str(), read.value);
    read.fast = end != nullptr && (*end == ' ' || *end == '\n');
    read.taken = read.fast && end == text.c_str() + word.size();
    if (read.fast) return read;
    const std::optional<double> number = number_in(word, Dialect::programs);
    read.taken = number.has_value();
    read.value = number.value_or(0);
    return read;
}

void expect_as_strtod(const std::string& word, int& fast) {
    const Read read = read_number(word);
    const double nearest = std::strtod(word.c_str(), nullptr);
    const bool same = std::bit_cast<std::uint64_t>(read.value) == std::bit_cast<std::uint64_t>(nearest);
    if (!read.taken || !same) FAIL() << word << " is read as " << read.value << ", taken: " << read.taken;
    fast += read.fast ? 1 : 0;
}

std::string printed(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string random_word(std::mt19937_64& random) {
    const std::uint64_t whole = random() >> (random() % 64);
    const int exponent = static_cast<int>(random() % 60) - 30;
    std::string digits = std::to_string(whole);
    switch (random() % 6) {
        case 0:
            return digits + "e" + std::to_string(exponent);
        case 1:
            digits.insert(random() % (digits.size() + 1), ".");
            return (random() % 2 == 0 ? "-" : "") + digits;
        case 2:
            digits.insert(random() % (digits.size() + 1), ".");
            return digits + (exponent < 0 ? "E" : "E+") + std::to_string(exponent);
        case 3: {
            const double any = std::bit_cast<double>(random());
            return printed("%.17g", std::isfinite(any) ? any : 1.0);
        }
        case 4:
            return printed("%.17g", std::uniform_real_distribution(-1.0, 1.0)(random));
        default:
            return printed("%g",
                           std::uniform_real_distribution(-1.0, 1.0)(random) * std::pow(10.0, exponent));
    }
}

TEST(DumpDecimals, AMillionWordsAreTheNearestDoubles) {
    std::mt19937_64 random(50);
    int fast = 0;
    for (int k = 0; k < 1000000; ++k) {
        expect_as_strtod(random_word(random), fast);
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(fast, 700000);  // most numbers go the fast way, so this way is tested
}

// (2m + 1) 2^s is in the middle of two doubles. It becomes the even one, and a number slightly larger becomes
// the upper one.
TEST(DumpDecimals, MiddlesGoToTheEvenDouble) {
    std::mt19937_64 random(51);
    int fast = 0;
    for (int k = 0; k < 100000; ++k) {
        const std::uint64_t middle = ((std::uint64_t{1} << 53 | random() >> 11) << 1 | 1) << random() % 9;
        for (const std::uint64_t near : {middle - 1, middle, middle + 1}) {
            expect_as_strtod(std::to_string(near), fast);
            expect_as_strtod(std::to_string(near) + "e3", fast);
            expect_as_strtod(std::to_string(near) + "e-3", fast);
        }
        if (HasFatalFailure()) return;
    }
    // These are middles with digits after the point: 1 + 2^-53 has 53 decimals, and 1/2 + 2^-54 + what 19
    // digits can express.
    for (const char* word :
         {"9007199254740993", "9007199254740995", "18014398509481986", "0.5000000000000000555",
          "1.1102230246251565e-16", "4503599627370496.5", "4503599627370497.5"})
        expect_as_strtod(word, fast);
    // Quotients that come out even: 5^27 2^k / 10^27.
    expect_as_strtod("7450580596923828125e-27", fast);
    expect_as_strtod("7450580596923828125e-18", fast);
}

TEST(DumpDecimals, OddWords) {
    int fast = 0;
    for (const char* word : {"0",
                             "-0",
                             "-0.0",
                             "+1.5",
                             ".5",
                             "5.",
                             "1e-400",
                             "-1e-400",
                             "1e400",
                             "-1e999",
                             "0e5",
                             "0e-400",
                             "9999999999999999999",
                             "18446744073709551615",
                             "6.69514e-204",
                             "4.9e-324",
                             "2.2250738585072011e-308",
                             "1.7976931348623157e308",
                             "0.00000000000000000000000000001",
                             "00000000000000000000012.5",
                             "1E6",
                             "inf",
                             "-inf",
                             "nan"})
        expect_as_strtod(word, fast);
    for (const char* word : {"1.#QNAN", "-1.#IND", "1.#SNAN", "-nan", "NaN"}) {
        const Read read = read_number(word);
        EXPECT_TRUE(read.taken && std::isnan(read.value)) << word;
    }
    EXPECT_EQ(read_number("-1.#INF").value, -std::numeric_limits<double>::infinity());
    EXPECT_EQ(read_number("1.5d-1").value, 0.15);
    for (const char* word :
         {"-", "+", "e5", "1e", "1e+", "1.5d", "1.2.3", "--1", "+-1", "0x10", "1,5", ".", "1 2"})
        EXPECT_FALSE(read_number(word).taken) << word;
}

}  // namespace
}  // namespace grainreel
