// Tests of figures of whole runs as their users meet them: the rate of a hopper, and means of fields.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::Not;

// 200 grains run out through a slot within a quarter of a second.
const std::string hopper = SmallScene("title = \"Hopper\"\n")
                               .beads(200, "sand", "3 mm")
                               .contacts("0.6", "0.3")
                               .box("20 mm", "15 mm", "60 mm")
                               .more(R"(outlet = { width = "12 mm", opens = "0.02 s", exit_depth = "10 mm" }
[start]
settle_limit = "0.01 s"
)")
                               .lasts("0.25 s")
                               .more(R"(overlap = 0.05
accuracy = "draft"
threads = 1
[output]
measures_interval = "5 ms"
[film]
size = "480x270"
rate = 4
)");

// Sixty grains in a shaken cylinder, with fields.
const std::string cylinder = SmallScene()
                                 .beads(60, "sand", "3 mm")
                                 .contacts("0.6", "0.3")
                                 .cylinder("20 mm", "60 mm")
                                 .shaken("40 Hz", "3")
                                 .more(R"(ramp = 0
[start]
settle_limit = "0.01 s"
)")
                                 .lasts("0.15 s")
                                 .more(R"(overlap = 0.05
accuracy = "draft"
threads = 1
[output.fields]
grid = "xyz"
periods = 1
samples = 4
cell = "4 mm"
width = "4 mm"
)");

class FiguresOfARun : public testing::Test {
  protected:
    Ended call(const std::vector<std::string>& words) const {
        return run_program(words, {.folder = folder.path()});
    }
    // Runs a scene without film and page.
    Ended run(const std::string& text, const std::string& name, std::vector<std::string> more = {}) const {
        write_text(folder / (name + ".toml"), text);
        more.insert(more.begin(), {"movie", name + ".toml", "--no-film", "--no-report", "--out", name});
        Ended ended = call(more);
        EXPECT_EQ(ended.status, 0) << ended.err;
        return ended;
    }
    nlohmann::json answer(std::vector<std::string> words) const {
        words.insert(words.begin(), "inspect");
        words.push_back("--json");
        const Ended ended = call(words);
        EXPECT_EQ(ended.status, 0) << ended.err;
        return nlohmann::json::parse(ended.out)["tables"];
    }
    // A value of a table of one row.
    static double value(const nlohmann::json& table, const std::string& column) {
        for (std::size_t k = 0; k < table["columns"].size(); ++k)
            if (table["columns"][k]["name"] == column)
                return table["rows"][0][k].is_null() ? std::nan("") : table["rows"][0][k].get<double>();
        ADD_FAILURE() << column;
        return std::nan("");
    }

    TemporaryFolder folder;
};

// W = 1.03 rho sqrt(g) (L - 1.4 d) (B - 1.4 d)^1.5 with 0.6 of the density.
double expected_of_slot(double width, double length, double diameter) {
    return 1.03 * 0.6 * 2500 * std::sqrt(9.81) * (length - 1.4 * diameter) *
           std::pow(width - 1.4 * diameter, 1.5);
}

TEST_F(FiguresOfARun, AHopperEndsWithItsRateAndBeverloos) {
    const Ended ended = run(hopper, "hopper");
    EXPECT_THAT(ended.err, tells({"outflow:", "kg/s", "empty at"}));
    EXPECT_THAT(ended.err, HasSubstr(fmt::format("Beverloo's law expects {:.4g} kg/s: W = 1.03",
                                                 expected_of_slot(0.012, 0.015, 0.003))));
    const auto told = answer({"hopper", "--discharge"})["discharge"];
    EXPECT_NEAR(value(told, "beverloo"), expected_of_slot(0.012, 0.015, 0.003), 1e-9);
    EXPECT_GT(value(told, "would_empty"), 0.25);
    EXPECT_TRUE(std::isnan(value(told, "emptied")));
}

TEST_F(FiguresOfARun, ARunThatGoesOnEndsWithItsRateToo) {
    const Ended begun = run(hopper, "hopper", {"--duration", "0.1 s"});
    EXPECT_THAT(begun.err, HasSubstr("outflow: "));
    const Ended ended = call({"resume", "hopper", "--until", "0.3 s"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("Beverloo's law expects"));
    // The floor is flat, so the last tenth lies beside the slot and does not come.
    EXPECT_THAT(ended.err, testing::ContainsRegex("outflow: .*; [0-9.]+ % of the mass stay inside"));
    EXPECT_TRUE(std::isnan(value(answer({"hopper", "--discharge"})["discharge"], "would_empty")));
}

// Where the depth is periodic, a slot has no ends; where more comes in, a vessel is not empty at any time.
TEST_F(FiguresOfARun, PeriodicSlotsAndFeedsHaveRatesToo) {
    std::string text = hopper;
    text.insert(text.find("outlet ="), "periodic_depth = true\n");
    EXPECT_THAT(
        run(text, "periodic").err,
        HasSubstr(fmt::format("expects {:.4g} kg/s", expected_of_slot(0.012, 0.015 + 1.4 * 0.003, 0.003))));
    text.insert(text.find("[start]"), "[[feed]]\nspecies = \"sand\"\nrate = 400\n");
    const Ended fed = run(text, "fed");
    EXPECT_THAT(fed.err, HasSubstr("outflow: "));
    EXPECT_THAT(fed.err, Not(HasSubstr("empty")));
    EXPECT_TRUE(std::isnan(value(answer({"fed", "--discharge"})["discharge"], "would_empty")));
}

TEST_F(FiguresOfARun, ComparedHoppersHaveARateEach) {
    write_text(folder / "hopper.toml", hopper);
    const Ended ended = call({"compare", "hopper.toml", "--vary", "contact.friction=0.1,0.3", "--out", "two",
                              "--format", "png", "--no-report"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    for (const std::string panel : {"hopper-friction-0.1", "hopper-friction-0.3"}) {
        EXPECT_THAT(ended.err, HasSubstr(panel + ": outflow: "));
        EXPECT_THAT(ended.err, HasSubstr(panel + ": Beverloo's law expects"));
    }
}

TEST_F(FiguresOfARun, FieldsHaveMeansOverRingsAndRecords) {
    run(cylinder, "cylinder");
    const auto rings = answer({"cylinder", "--fields", "rz", "--window", "0.05s.."});
    EXPECT_THAT(rings.dump(), tells({"density", "velocity_z", "velocity_r", "turnover"}));
    EXPECT_THAT(answer({"cylinder", "--fields", "kept"}).dump(), tells({"velocity_x", "velocity_y"}));
    const auto refused = [&](const std::vector<std::string>& words) {
        const Ended ended = call(words);
        EXPECT_EQ(ended.status, 2) << ended.out;
        return ended.err;
    };
    EXPECT_THAT(refused({"inspect", "cylinder", "--fields", "rz", "--window", "5s.."}),
                tells({"no record", "within 5 s"}));
    EXPECT_THAT(refused({"inspect", "cylinder", "--fields", "tz"}), tells({"--fields", "rz"}));
    EXPECT_THAT(refused({"inspect", "cylinder", "--discharge"}), tells({"--discharge", "outlet"}));
    run(hopper, "hopper");
    EXPECT_THAT(refused({"inspect", "hopper", "--fields", "rz"}), tells({"no fields", "[output.fields]"}));
}

// The table of parameters names law and numbers of each pair, and what the plan chose.
TEST_F(FiguresOfARun, ParametersAreATable) {
    run(hopper, "hopper");
    const Ended ended = call({"inspect", "hopper", "--parameters", "--csv"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    for (const char* words :
         {"contact.", "stiffness", "run.step", "restitution", "program.version", "walton-braun"})
        EXPECT_THAT(ended.out, HasSubstr(words));
}

}  // namespace
}  // namespace grainreel
