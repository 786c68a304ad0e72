// Tests of units: which are accepted, and which are refused.
#include "engine/scene/text/units.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <thread>

#include "engine/base/error.hpp"
#include "render/scene/axis_titles.hpp"

namespace grainreel {
namespace {

struct Good {
    const char* text;
    Dimension dimension;
    double value;
};

class UnitsAccepted : public testing::TestWithParam<Good> {};

TEST_P(UnitsAccepted, ConvertToSi) {
    EXPECT_DOUBLE_EQ(parse_quantity(GetParam().text, GetParam().dimension), GetParam().value);
}

INSTANTIATE_TEST_SUITE_P(
    All, UnitsAccepted,
    testing::Values(Good{"2 mm", Dimension::length, 0.002}, Good{"4.5mm", Dimension::length, 0.0045},
                    Good{"0.3 cm", Dimension::length, 0.003}, Good{"250 µm", Dimension::length, 250e-6},
                    Good{"25 Hz", Dimension::frequency, 25}, Good{"0.1 kHz", Dimension::frequency, 100},
                    Good{"25 1/s", Dimension::frequency, 25}, Good{"10 1/s", Dimension::rate, 10},
                    Good{"2.5 g/cm3", Dimension::density, 2500},
                    Good{"9.81 m/s2", Dimension::acceleration, 9.81}, Good{"25 cm/s", Dimension::speed, 0.25},
                    Good{"981 cm/s^2", Dimension::acceleration, 9.81},
                    Good{"2e4 N/m", Dimension::stiffness, 2e4},
                    Good{"20 deg", Dimension::angle, 20 * std::numbers::pi / 180},
                    Good{"0.5 rad", Dimension::angle, 0.5}, Good{"20 deg", Dimension::degrees, 20},
                    Good{"90 deg", Dimension::phase, 0.25}, Good{"0.75 turn", Dimension::phase, 0.75},
                    Good{"-90 °", Dimension::phase, -0.25}, Good{"1 week", Dimension::time, 7 * 24 * 3600},
                    Good{"  20 ms ", Dimension::time, 0.02}, Good{"0.16 g", Dimension::mass, 0.00016}));

TEST(Units, DecimalsKeepTheirLastBit) {
    EXPECT_EQ(parse_quantity("4.5 mm", Dimension::length), 0.0045);
    EXPECT_EQ(parse_quantity("90 deg", Dimension::phase), 0.25);
    EXPECT_EQ(parse_quantity("0.7 ms", Dimension::time), 0.0007);
    EXPECT_EQ(parse_quantity("2.5 g/cm3", Dimension::density), 2500);
    EXPECT_EQ(parse_quantity("7.8 g/cm3", Dimension::density), 7800);
    EXPECT_EQ(parse_quantity("1.2 kN/m", Dimension::stiffness), 1200);
    EXPECT_EQ(parse_quantity("3 N/mm", Dimension::stiffness), 3000);
    EXPECT_EQ(parse_quantity("1.3 MPa", Dimension::pressure), 1.3e6);
}

struct Bad {
    const char* text;
    Dimension dimension;
    const char* message;
};

class UnitsRefused : public testing::TestWithParam<Bad> {};

TEST_P(UnitsRefused, SayWhatWasExpected) {
    try {
        parse_quantity(GetParam().text, GetParam().dimension);
        FAIL() << "accepted " << GetParam().text;
    } catch (const UserError& error) {
        EXPECT_STREQ(error.what(), GetParam().message);
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, UnitsRefused,
    testing::Values(
        Bad{"2 mm", Dimension::frequency,
            "must be a frequency, but \"2 mm\" is a length; write for example \"25 Hz\""},
        Bad{"20 Hz", Dimension::angle,
            "must be an angle, but \"20 Hz\" is a frequency; write for example \"20 deg\""},
        // The library udunits takes the radian for 1 and would accept these, wrong by 2 pi.
        Bad{"25 rad/s", Dimension::frequency,
            "must be a frequency, but \"25 rad/s\" is an angular velocity; write for example \"25 Hz\""},
        Bad{"150 rpm", Dimension::frequency,
            "must be a frequency, but \"150 rpm\" is an angular velocity; write for example \"25 Hz\""},
        Bad{"3 deg", Dimension::length,
            "must be a length, but \"3 deg\" is an angle; write for example \"5 mm\""},
        Bad{"50 %", Dimension::angle,
            "must be an angle, but \"50 %\" has the unknown unit \"%\"; write for example \"20 deg\""},
        Bad{"5 mmm", Dimension::length,
            "must be a length, but \"5 mmm\" has the unknown unit \"mmm\"; write for example \"5 mm\""},
        Bad{"5", Dimension::length, "must be a length, but \"5\" has no unit; write for example \"5 mm\""},
        Bad{"mm", Dimension::length,
            "must be a length, but \"mm\" does not begin with a number; write for example \"5 mm\""},
        Bad{"nan mm", Dimension::length,
            "must be a length, but \"nan mm\" does not begin with a number; write for example \"5 mm\""},
        Bad{"0.5 m", Dimension::number,
            "must be a plain number, but \"0.5 m\" has a unit; write for example 0.5"},
        // udunits would read 1 times 000 mm, a comma as nothing, and offsets.
        Bad{"1 000 mm", Dimension::length,
            "must be a length, but \"1 000 mm\" has the unknown unit \"000 mm\"; write for example \"5 mm\""},
        Bad{"1,5 mm", Dimension::length,
            "must be a length, but \"1,5 mm\" has a comma in its number; write \"1.5 mm\""},
        Bad{"0,5", Dimension::number,
            "must be a plain number, but \"0,5\" has a comma in its number; write 0.5"},
        Bad{"5 mm @ 3", Dimension::length,
            "must be a length, but \"5 mm @ 3\" has the unknown unit \"mm @ 3\"; write for example \"5 "
            "mm\""}));

TEST(Units, HaveASizeInTheirDimension) {
    EXPECT_EQ(unit_size_in("mm", Dimension::length), 1e-3);
    EXPECT_EQ(unit_size_in("µm", Dimension::length), 1e-6);
    EXPECT_EQ(unit_size_in("micron", Dimension::length), 1e-6);
    EXPECT_EQ(unit_size_in("h", Dimension::time), 3600);
    EXPECT_EQ(unit_size_in("cm/s", Dimension::speed), 1e-2);
    EXPECT_EQ(unit_size_in("g", Dimension::mass), 1e-3);
    for (const char* word : {"", "s", "-", "1", "grain", "2 mm"})
        EXPECT_FALSE(unit_size_in(word, Dimension::length)) << word;
}

TEST(Units, LabelsMaySayTheirOwn) {
    const auto parts = [](const char* label, Dimension dimension) {
        const LabelParts found = label_parts(label, dimension);
        return found.words + "|" + found.unit;
    };
    for (const char* label : {"sand (g)", "sand [g]", "sand, g", "sand in g"})
        EXPECT_EQ(parts(label, Dimension::mass), "sand|g") << label;
    EXPECT_EQ(parts("Höhe der Großen (cm)", Dimension::length), "Höhe der Großen|cm");
    EXPECT_EQ(parts("pushed, kg/s", Dimension::mass_flow), "pushed|kg/s");
    // Words that are no unit of the quantity stay where they are.
    for (const char* label :
         {"sand", "sand (mm)", "sand (fine)", "(g)", "bed in the box", "sand (g) left", ""})
        EXPECT_EQ(parts(label, Dimension::mass), std::string(label) + "|");
    EXPECT_EQ(parts("share (m)", Dimension::number), "share (m)|");
    EXPECT_EQ(with_unit("sand (g)", "kg", Dimension::mass), "sand (kg)");
    EXPECT_EQ(with_unit("sand", "kg", Dimension::mass), "sand (kg)");
    EXPECT_EQ(with_unit("share", ""), "share");
}

TEST(Units, AreSafeFromSeveralThreads) {
    std::vector<std::thread> threads;
    std::vector<double> sums(4, 0);
    for (std::size_t t = 0; t < sums.size(); ++t)
        threads.emplace_back([t, &sums] {
            for (int i = 0; i < 200; ++i) sums[t] += parse_quantity("2 mm", Dimension::length);
        });
    for (std::thread& thread : threads) thread.join();
    for (const double sum : sums) EXPECT_NEAR(sum, 200 * 0.002, 1e-12);
}

}  // namespace
}  // namespace grainreel
