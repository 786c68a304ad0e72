// Tests of values that nobody means: they give a warning with the number and the likely mistake, or a
// refusal.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/plan/plan.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using test::tells_only;
using testing::AllOf;
using testing::HasSubstr;

std::string warnings(const Assignments& sets, const std::string& text = wedge_text) {
    std::string all;
    for (const std::string& line : make_plan(read_text(text, sets)).warnings) all += line + "\n";
    return all;
}

std::string first_warning(const Assignments& sets) {
    const std::string all = warnings(sets);
    return all.substr(0, all.find('\n'));
}

std::string complaint(const Assignments& sets, const std::string& text = wedge_text) {
    try {
        make_plan(read_text(text, sets));
    } catch (const UserError& error) {
        return error.what();
    }
    return "none";
}

TEST(Slips, OfUnits) {
    EXPECT_THAT(first_warning({"species.small.density=7.8"}),
                tells_only({"--set species.small.density", "7.8 kg/m3", "less than foam", "without a unit",
                            "\"7.8 g/cm3\"?"}));
    EXPECT_THAT(warnings({"species.small.density=7800000"}),
                tells({"7.8e+06 kg/m3", "any solid", "in kg/m3"}));
    EXPECT_THAT(warnings({"species.small.density=2.5e6"}), HasSubstr("more than any solid"));
    EXPECT_THAT(warnings({"species.small.mass=0.16 kg"}), tells({"mass", "density"}));
    EXPECT_THAT(warnings({"species.small.diameter=5 µm"}), tells({"5e-06 m", "stick"}));
    const Assignments in_mm{"species.small.diameter=5",  "species.big.diameter=10",
                            "container.slant_height=70", "container.half_width=55",
                            "container.depth=45",        "container.height=180"};
    EXPECT_THAT(warnings(in_mm),
                AllOf(HasSubstr("did you mean \"5 mm\"?"), HasSubstr("did you mean \"10 mm\"?"),
                      HasSubstr("did you mean \"180 mm\"?")));
    EXPECT_THAT(warnings({"gravity=981"}), tells({"--set gravity", "981 m/s2", "100 times", "Earth",
                                                  "without a unit", "\"981 cm/s2\"?"}));
}

TEST(Slips, OfTheDrive) {
    EXPECT_THAT(first_warning({"drive.amplitude=3"}),
                tells_only({"--set drive.amplitude", "3 m", "0.18 m", "without a unit", "\"3 mm\"?"}));
    const double omega = 2 * std::numbers::pi * 0.1;
    EXPECT_THAT(
        warnings({"drive.frequency=0.1"}),
        AllOf(HasSubstr(fmt::format("an amplitude of {:.4g} m is more than the height of the container",
                                    3 * 10 / (omega * omega))),
              tells({"10 s", "longer", "2 s", "raise the frequency"})));
    EXPECT_THAT(warnings({"drive.frequency=20 kHz"}), HasSubstr("did you mean \"20 Hz\"?"));
    const double shaken = 2 * std::numbers::pi * 20;
    EXPECT_THAT(warnings({"drive.amplitude=10 cm"}),
                HasSubstr(fmt::format("g_level is {:.4g}, with 20 Hz and an amplitude of 0.1 m",
                                      0.1 * shaken * shaken / 10)));
}

TEST(Slips, OfFriction) {
    EXPECT_THAT(warnings({"contact.friction=50"}),
                tells_only({"--set contact.friction", "friction of 50", "more than", "0.5?", "inf"}));
    EXPECT_EQ(warnings({"contact.friction=inf"}), "");
    EXPECT_THAT(warnings({"contact.rolling_friction=10"}), tells({"rolling friction", "10", "more than"}));
}

TEST(Slips, OfGravityAndTheFloor) {
    EXPECT_THAT(warnings({"gravity=[0, 0, 9.81]"}),
                tells_only({"--set gravity", "points up", "9.81 m/s2", "lid", "downwards"}));
    EXPECT_THAT(complaint({"gravity=[0, 0, 9.81]", "container.top=open"}),
                tells_only({"--set gravity", "'gravity'", "points up", "9.81 m/s2", "fall out",
                            "gravity = 9.81", "\"lid\""}));
    // The slants take 70 tan 20 deg = 25.478 mm on either side.
    const double floor = 2 * (0.027 - 0.07 * std::tan(20 * std::numbers::pi / 180));
    EXPECT_EQ(
        warnings({"container.half_width=27 mm"}),
        fmt::format("--set container.half_width: the floor is {:.4g} m wide, less than the smallest grain, "
                    "0.005 m: grains hang between the slanted walls and none lies on it; raise half_width, "
                    "or lower half_angle or slant_height, unless you mean a V\n",
                    floor));
}

TEST(Slips, OfNames) {
    EXPECT_THAT(complaint({"species[1].name=\"small \""}),
                tells_only({"--set species[1].name", "'name'", "\"small \"", "taken", "another"}));
    EXPECT_THAT(complaint({"species[0].name=1,5 mm", "species[1].name=1\"5 mm"}),
                tells_only({"test.toml:3:3", "\"1_5 mm_centre_x_m\"", "twice", "choose names"}));
}

TEST(Slips, PlausibleScenesHaveNone) {
    for (const char* set : {"species.small.density=30", "species.small.density=\"19.3 g/cm3\"",
                            "gravity=1.62", "species.small.diameter=4 mm", "drive.frequency=400",
                            "container.half_width=30 mm", "contact.friction=1.2"})
        EXPECT_EQ(complaint({set}), "none") << set;
    EXPECT_EQ(warnings({"species.small.count=1000", "contact.friction=1.2", "species.small.density=2000"}),
              "");
}

}  // namespace
}  // namespace grainreel
