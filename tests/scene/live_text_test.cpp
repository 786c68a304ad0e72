// Tests of live words, which show measures in a film.
#include "render/scene/live_text.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.hpp"
#include "engine/measure/flow/beverloo.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;

const std::vector<MeasureColumn>& columns() {
    static const std::vector<MeasureColumn> all = measure_columns(read_text(wedge_text));
    return all;
}

std::string shown(const std::string& text, std::optional<double> value) {
    return live_text(parse_live_text(text, columns()), [&](const LiveWords&) { return value; });
}

TEST(LiveText, ShowsValuesInTheirUnits) {
    EXPECT_EQ(shown("no values", 1), "no values");
    EXPECT_EQ(shown("mixing {lacey} of 1", 0.81234), "mixing 0.812 of 1");
    EXPECT_EQ(shown("{kinetic_J}\n{kinetic:mJ}", 0.0123), "0.0123 J\n12.3 mJ");
    EXPECT_EQ(shown("{height_difference}", -0.25), "−0.25");
    EXPECT_EQ(shown("{big_in_top_quarter:%}", 0.951), "95.1 %");
    EXPECT_EQ(shown("{{lacey} {lacey}", 0.5), "{lacey} 0.5");
    EXPECT_EQ(shown("{kinetic}", std::nullopt), "– J");
    EXPECT_EQ(shown("{lacey} {unlike_neighbours}", std::nan("")),
              "– –");  // the measure is not defined for this bed
    EXPECT_EQ(shown("{big_above_small} {big_in_top_quarter}", 0.5), "0.5 0.5");
    // A unit that the name does not have.
    EXPECT_EQ(shown("{outflow_rate} {outflow_rate:g/s} {outflow}", 0.0025), "0.0025 kg/s 2.5 g/s 0.0025 kg");
}

// The mean rate is that between 10 % and 70 % of what is out; the law's is that of the scene.
TEST(LiveText, RatesOfOutflowAreNoColumns) {
    const Scene scene = read_text(
        "[[species]]\nname = \"sand\"\ncount = 10\ndiameter = \"2 mm\"\ndensity = \"2.5 g/cm3\"\n"
        "[contact]\nrestitution = 0.8\nfriction = 0.4\n[container]\nshape = \"cylinder\"\n"
        "diameter = \"60 mm\"\nheight = \"80 mm\"\noutlet = { diameter = \"14 mm\" }\n[run]\nduration = "
        "\"1 s\"\n");
    MeasureTable table({"time_s", "outflow_kg"});
    const auto words =
        parse_live_text("{outflow_mean:g/s} g/s of {outflow_law:g/s}", measure_columns(scene), &scene);
    const auto after = [&](std::size_t rows) {
        return live_text(words, [&](const LiveWords& part) { return live_number(part, &table, rows); });
    };
    const double law = 1000 * *beverloo_rate(scene);
    EXPECT_EQ(after(0), fmt::format("– g/s of {:.3g} g/s", law));
    // Nothing for a second, then 20 g/s, and after 5 s no more.
    for (const auto& [time, gone] : {std::pair{0.0, 0.0},
                                     {1.0, 0.0},
                                     {2.0, 0.02},
                                     {3.0, 0.04},
                                     {4.0, 0.06},
                                     {5.0, 0.08},
                                     {6.0, 0.1},
                                     {7.0, 0.1},
                                     {8.0, 0.1}})
        table.add({time, gone});
    EXPECT_EQ(after(2), fmt::format("– g/s of {:.3g} g/s", law));
    EXPECT_EQ(after(table.rows()), fmt::format("20 g/s of {:.3g} g/s", law));
    const Scene closed = read_text(wedge_text);
    EXPECT_THAT(
        [&] { parse_live_text("{outflow_law}", columns(), &closed); },
        testing::ThrowsMessage<UserError>(tells({"{outflow_law}", "Beverloo's law", "container.outlet"})));
}

// The unit comes with the value, so words that have it too do not double it.
TEST(LiveText, AUnitStandsOnce) {
    EXPECT_EQ(shown("{outflow_kg:g} g of sand", 0.0337), "33.7 g of sand");
    EXPECT_EQ(shown("{outflow_kg:g}g, no more", 0.0337), "33.7 g, no more");
    EXPECT_EQ(shown("{outflow_kg:g} grains", 0.0337), "33.7 g grains");
    EXPECT_EQ(shown("{outflow_kg:g} kg", 0.0337), "33.7 g kg");
    EXPECT_EQ(shown("{lacey} g", 0.5), "0.5 g");
}

TEST(LiveText, SaysWhatIsWrong) {
    const auto complaint = [](const std::string& text) -> std::string {
        try {
            parse_live_text(text, columns());
            return "accepted";
        } catch (const UserError& error) {
            return error.what();
        }
    };
    EXPECT_THAT(complaint("{gone}"), tells({"{gone}", "no column", "measures.csv", "there are"}));
    EXPECT_THAT(complaint("{lacey"), testing::HasSubstr("a { without its }"));
    EXPECT_THAT(complaint("{lacey:m}"), testing::HasSubstr("pure number"));
    EXPECT_THAT(complaint("{kinetic:mm}"), testing::HasSubstr("energy"));
    EXPECT_THAT(complaint("{outflow_rate:mm}"), testing::HasSubstr("mass flow"));
    EXPECT_THAT(complaint("{step}"), testing::HasSubstr("no column"));
}

}  // namespace
}  // namespace grainreel
