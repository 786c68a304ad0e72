// Tests of the words that are numbers, in both dialects. DumpDecimals (tests/foreign) compares a million of
// them with strtod.
#include "engine/base/number_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace grainreel {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Known {
    const char* word;
    double value;
};

std::optional<double> of_programs(std::string_view word) {
    return number_in(word, Dialect::programs);
}

TEST(NumberText, PlainNumbersAreNumbersInBothDialects) {
    for (const Known& one : std::vector<Known>{{"1.5", 1.5},
                                               {"+1.5", 1.5},
                                               {".5", 0.5},
                                               {"5.", 5},
                                               {"-2e-3", -2e-3},
                                               {"1E6", 1e6},
                                               {"007", 7},
                                               {"4.9e-324", 4.9e-324}}) {
        EXPECT_EQ(number_in(one.word), one.value) << one.word;
        EXPECT_EQ(of_programs(one.word), one.value) << one.word;
    }
}

TEST(NumberText, WhatProgramsWriteIsNoPlainNumber) {
    for (const char* word :
         {"nan", "-nan", "NaN", "nan(ind)", "-nan(ind)", "1.#QNAN", "-1.#IND", "1.#IND00"}) {
        EXPECT_FALSE(number_in(word)) << word;
        EXPECT_TRUE(std::isnan(of_programs(word).value_or(0))) << word;
    }
    for (const Known& one : std::vector<Known>{{"inf", infinite},
                                               {"-inf", -infinite},
                                               {"Infinity", infinite},
                                               {"-1.#INF", -infinite},
                                               {"1.#INF00", infinite},
                                               {"1.5d0", 1.5},
                                               {"-2.5D-01", -0.25},
                                               {"1d+3", 1000}}) {
        EXPECT_FALSE(number_in(one.word)) << one.word;
        EXPECT_EQ(of_programs(one.word), one.value) << one.word;
    }
}

TEST(NumberText, BeyondTheRangeIsZeroOrInfinity) {
    const std::string zeros(400, '0');
    for (const std::string& word : std::vector<std::string>{
             "1e-400", "0." + zeros + "1", "1e-99999999999999999999", "5d-999", "0." + zeros + "1e50"}) {
        EXPECT_EQ(of_programs(word), 0) << word;
        EXPECT_EQ(of_programs("-" + word), 0) << word;
    }
    for (const std::string& word : std::vector<std::string>{"1e400", "1" + zeros, "1e99999999999999999999",
                                                            "5d999", "1" + zeros + "e-50"}) {
        EXPECT_EQ(of_programs(word), infinite) << word;
        EXPECT_EQ(of_programs("-" + word), -infinite) << word;
        EXPECT_FALSE(number_in(word)) << word;
    }
    EXPECT_EQ(number_in("1e-400"), 0);
}

TEST(NumberText, OtherWordsAreNone) {
    for (const char* word : {"",      "-",     "+",   ".",     "e5",   "1e",   "1e+", "1.5d",    "d5",
                             "1d2d3", "1.2.3", "--1", "+-1",   "++1",  "0x10", "1,5", "1 2",     " 1",
                             "1 ",    "3#x",   "1.#", "1.#IN", "-1.#", "nan(", "one", "********"}) {
        EXPECT_FALSE(number_in(word)) << word;
        EXPECT_FALSE(of_programs(word)) << word;
    }
}

TEST(NumberText, WholeNumbers) {
    EXPECT_EQ(whole_in("324"), 324);
    EXPECT_EQ(whole_in("+324"), 324);
    EXPECT_EQ(whole_in("-324"), -324);
    for (const char* word : {"", "+", "+-3", "3.0", "3e2", "99999999999999999999", "3 "})
        EXPECT_FALSE(whole_in(word)) << word;
}

}  // namespace
}  // namespace grainreel
