// Tests of values exactly at a bound, written as decimals in different units: numbers that are meant to be
// equal count as equal.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/plan/plan.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;

std::string complaint(const std::string& text, const Assignments& sets = {}) {
    try {
        make_plan(read_text(text, sets));
    } catch (const UserError& error) {
        return error.what();
    }
    return "";
}

const std::string periodic = with(box_text, "depth = 0.02\n", "depth = 0.02\nperiodic_depth = true\n");

TEST(Decimals, AreTheSameUpToRounding) {
    EXPECT_FALSE(clearly_less(2.5 * 0.00224, 0.0056) || clearly_more(2.5 * 0.00224, 0.0056));
    EXPECT_TRUE(clearly_less(0.0056, 0.0056001));
    EXPECT_TRUE(clearly_more(0, -1e-20));
}

// The period is 2.5 diameters, for every diameter of three digits.
TEST(Bounds, APeriodOfTwoAndAHalfDiameters) {
    for (int hundredths = 100; hundredths < 400; ++hundredths) {
        const Assignments sets{
            fmt::format("species.b.diameter={}.{:02} mm", hundredths / 100, hundredths % 100),
            "species.a.diameter=0.9 mm", fmt::format("container.depth={:.4f} mm", 2.5 * hundredths / 100)};
        EXPECT_EQ(complaint(periodic, sets), "") << sets[0].text << " " << sets[2].text;
    }
    EXPECT_THAT(complaint(periodic, {"container.depth=4.99 mm"}),
                testing::HasSubstr("too short to be periodic"));
}

// Along x a plane must go on at the boundary of the period.
TEST(Bounds, APlaneAlongAPeriod) {
    const auto with_plane = [](const std::string& text, const char* normal) {
        return complaint(fmt::format("{}\n[[wall]]\npoint = [0, 0, 0.001]\nnormal = {}\n", text, normal));
    };
    for (const char* leans : {"[0.6, 0, 0.8]", "[1, 0, 0]", "[-0.002, 0, 1]"}) {
        EXPECT_THAT(with_plane(periodic, leans), tells({"'normal'", "leans along x", "periodic_depth"}))
            << leans;
        EXPECT_EQ(with_plane(box_text, leans), "") << leans;
    }
    EXPECT_EQ(with_plane(periodic, "[0, -0.6, 0.8]"), "");
}

// A plane in a face of the container, or in another plane, would be touched twice. One that leaves it is
// none.
TEST(Bounds, APlaneInAnotherPlane) {
    const auto with_plane = [](const std::string& text, const char* keys) {
        return complaint(fmt::format("{}\n[[wall]]\n{}\n", text, keys));
    };
    const auto refused = [](const char* other) { return tells({"'point'", other, "would touch both"}); };
    const std::string one = "point = [0, 0, 0.005]\nnormal = [0, 0.6, 0.8]\n",
                      planes = box_text + "\n[[wall]]\nname = \"ramp\"\n" + one;
    EXPECT_THAT(with_plane(planes, "point = [1, 0.8, -0.595]\nnormal = [0, 3, 4]"), refused("\"ramp\""));
    EXPECT_THAT(with_plane(planes, "point = [1, 0.8, -0.595]\nnormal = [0, -3, -4]"),
                tells({"leave no room"}))
        << "the other side";
    EXPECT_EQ(with_plane(planes, "point = [0, 0, 0.006]\nnormal = [0, 3, 4]"), "") << "a millimetre above";
    EXPECT_EQ(with_plane(planes, "point = [0, 0, 0.005]\nnormal = [0, 3, 4]\nvelocity = [0, 0, 1]"), "");
    EXPECT_THAT(with_plane(planes, "point = [0, 0, 0.005]\nnormal = [0, 3, 4]\nvelocity = [1, 0, 0]"),
                refused("\"ramp\""));
    EXPECT_THAT(with_plane(box_text, "point = [1, 1, 0]\nnormal = [0, 0, 1]"), refused("floor"));
    EXPECT_THAT(with_plane(with(wedge_text, "depth =", "top = \"lid\"\ndepth ="),
                           "point = [0, 0, 0.18]\nnormal = [0, 0, -1]\nmoves = true"),
                refused("lid"));
    EXPECT_THAT(with_plane(wedge_text, "point = [0, 0, 0]\nnormal = [0, 0, 1]\nmoves = true"),
                refused("floor"));
    EXPECT_EQ(with_plane(wedge_text, "point = [0, 0, 0]\nnormal = [0, 0, 1]"), "") << "the floor shakes";
}

TEST(Bounds, GrainsThatJustFit) {
    for (const char* size : {"2.2", "3.3", "5.6", "6.7", "7.1"}) {
        const std::string mm = fmt::format("{} mm", size), um = fmt::format("{}00 µm", size);
        const auto shrunk = [&](std::string text) {
            text.erase(text.find('.'), 1);
            return text;
        };
        const Assignments sets{"species.b.count=1", "species.b.diameter=" + mm,
                               "container.width=" + shrunk(um), "run.step=1e-6"};
        EXPECT_EQ(complaint(box_text, sets), "") << mm;
    }
}

TEST(Bounds, OfTheWedge) {
    for (const char* high : {"7.1", "6.7", "11.3"})
        EXPECT_EQ(complaint(wedge_text,
                            {fmt::format("container.height={} cm", high),
                             fmt::format("container.slant_height={}e-2", high), "species.small.count=10"}),
                  "");
    // The slants meet at the floor: 45 degrees over a height equal to the half-width.
    EXPECT_EQ(complaint(wedge_text, {"container.half_angle=45 deg", "container.slant_height=5.5 cm"}), "");
    EXPECT_THAT(complaint(wedge_text, {"container.half_angle=45 deg", "container.slant_height=5.51 cm"}),
                testing::HasSubstr("would cross"));
}

TEST(Bounds, OfOutletAndTray) {
    const auto out = [](const std::string& table) {
        return Assignments{"container.outlet=" + table, "species.small.count=50"};
    };
    EXPECT_EQ(complaint(wedge_text, out("{ width = \"0.01 m\" }")), "") << "as wide as the largest";
    // The least is twice the stroke's amplitude plus a radius.
    const double least = 2 * read_text(wedge_text).drive.amplitude + 0.005;
    EXPECT_EQ(complaint(wedge_text,
                        out(fmt::format("{{ width = 0.02, exit_depth = {:.17g} }}", least * (1 - 1e-15)))),
              "");
    EXPECT_THAT(
        complaint(wedge_text, out(fmt::format("{{ width = 0.02, exit_depth = {:.17g} }}", 0.99 * least))),
        testing::HasSubstr("may still touch the floor"));
}

TEST(Bounds, OfTimes) {
    const std::string captions = wedge_text +
                                 "[[film.caption]]\nfrom = \"0.1 s\"\nto = \"700.7 ms\"\ntext = \"a\"\n"
                                 "[[film.caption]]\nfrom = 0.7007\ntext = \"b\"\n";
    EXPECT_EQ(complaint(captions), "");
    const std::string segments =
        wedge_text + "[[film.segment]]\nduration = \"700.7 ms\"\n[[film.segment]]\nduration = 1.2993\n";
    EXPECT_EQ(complaint(segments), "");
    const std::string grid = "[output.fields]\ngrid = \"yz\"\ninterval = \"100.1 ms\"\n";
    EXPECT_EQ(complaint(box_text + grid, {"run.duration=0.1001"}), "");
    EXPECT_EQ(complaint(wedge_text + "[film.camera]\nelevation = \"0.25 turn\"\n"), "");
}

TEST(Bounds, OfFeeds) {
    const std::string fed =
        wedge_text + "[[feed]]\nrate = 10\nlow = [0, 0, \"160.3 mm\"]\nhigh = [0, 0, 0.1603]\n";
    EXPECT_EQ(complaint(fed), "");
    // The only place is a radius below the lid.
    EXPECT_EQ(complaint(wedge_text +
                        "[[feed]]\nrate = 10\nlow = [0, 0, \"177.5 mm\"]\nhigh = [0, 0, \"0.1775 m\"]\n"),
              "");
}

TEST(Bounds, OfGluedGrains) {
    const std::string rough =
        "container.wall_grains={ species = \"a\", faces = [\"floor\", \"left_wall\", \"right_wall\"] }";
    EXPECT_EQ(complaint(with(box_text, "width = 0.02", "width = \"3.3 mm\""),
                        {rough, "species.a.diameter=1.1 mm", "species.b.diameter=2.2 mm", "species.a.count=1",
                         "species.b.count=1"}),
              "");
}

}  // namespace
}  // namespace grainreel
