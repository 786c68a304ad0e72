// Tests of the values of a study's axes: numbers, ranges and units.
#include "render/app/study/file/variations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

using testing::ElementsAre;

TEST(StudyValues, NumbersAsTheyAreWritten) {
    EXPECT_EQ(written_number("3")->number, 3);
    EXPECT_EQ(written_number("\"9 mm\"")->number, 9);
    EXPECT_EQ(written_number("\"9mm\"")->unit, "mm");
    EXPECT_EQ(written_number("\"2.5 g/cm3\"")->unit, "g/cm3");
    EXPECT_FALSE(written_number("\"hertz\""));
    EXPECT_FALSE(written_number("true"));
    EXPECT_FALSE(written_number("[1.0, 2.0]"));
}

TEST(StudyValues, RangesByCountAndByStep) {
    EXPECT_THAT(range_values({"1", "3", 5, "", false}), ElementsAre("1", "1.5", "2", "2.5", "3"));
    EXPECT_THAT(range_values({"0.1", "0.4", {}, "0.1", false}), ElementsAre("0.1", "0.2", "0.3", "0.4"));
    EXPECT_THAT(range_values({"3", "1", {}, "-1", false}), ElementsAre("3", "2", "1"));
    EXPECT_THAT(range_values({"1", "2", {}, "0.4", false}), ElementsAre("1", "1.4", "1.8"));
    EXPECT_THAT(range_values({"\"5 mm\"", "\"6 mm\"", 3, "", false}),
                ElementsAre("\"5 mm\"", "\"5.5 mm\"", "\"6 mm\""));
    EXPECT_THAT(range_values({"1", "1000", 4, "", true}), ElementsAre("1", "10", "100", "1000"));
}

TEST(StudyValues, MalformedRanges) {
    const ValueRange wrong[] = {{"\"x\"", "3", 3, "", false},
                                {"1", "\"3 mm\"", 3, "", false},
                                {"1", "3", {}, "", false},
                                {"1", "3", 3, "1", false},
                                {"1", "3", {}, "-1", false},
                                {"1", "3", {}, "0", false},
                                {"0", "3", 4, "", true},
                                {"2", "2", 4, "", false},
                                {"1", "3", {}, "1e-9", false},
                                {"inf", "3", 3, "", false},
                                {"\"1 mm\"", "\"3 mm\"", {}, "1", false}};
    for (const ValueRange& range : wrong)
        EXPECT_THROW(range_values(range), UserError) << range.from << " " << range.to << " " << range.by;
}

Variation of(const std::vector<std::string>& toml) {
    Variation variation;
    for (const std::string& value : toml)
        variation.values.push_back(
            {value, value.front() == '"' ? value.substr(1, value.size() - 2) : value, "", 0});
    return variation;
}

TEST(StudyValues, AnAxisKeepsItsUnitWhereThereIsOne) {
    const Key& diameter = *find_key("species[0].diameter");
    Variation same = of({"\"9 mm\"", "\"18 mm\""});
    make_numeric(same, diameter);
    EXPECT_TRUE(same.numeric);
    EXPECT_EQ(same.unit, "mm");
    EXPECT_EQ(same.values[1].number, 18);
    Variation mixed = of({"\"9 mm\"", "0.018", "\"2 cm\""});
    make_numeric(mixed, diameter);
    EXPECT_EQ(mixed.unit, "m");
    EXPECT_DOUBLE_EQ(mixed.values[0].number, 0.009);
    EXPECT_DOUBLE_EQ(mixed.values[1].number, 0.018);
    EXPECT_DOUBLE_EQ(mixed.values[2].number, 0.02);
    Variation words = of({"\"hertz\"", "\"walton-braun\""});
    make_numeric(words, *find_key("contact.law"));
    EXPECT_FALSE(words.numeric);
}

}  // namespace
}  // namespace grainreel
