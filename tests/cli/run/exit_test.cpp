// Tests of grains that leave through an [[exit]]. They are in outflow.csv, as with an outlet, and a run that
// is continued keeps this file.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/files/measures_csv.hpp"
#include "tests/cli/program.hpp"
#include "tests/cli/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;

// Three balls fall freely from 10, 30 and 50 mm above the exit's upper side. A fourth one is too high to
// reach it.
const char* const falling = R"(gravity = 10
[[species]]
name = "ball"
diameter = "4 mm"
density = 2500
[contact]
restitution = 0.8
friction = 0.3
stiffness = "1000 N/m"
[container]
shape = "none"
[[grain]]
position = [0, 0, "30 mm"]
[[grain]]
position = [0.02, 0, "10 mm"]
[[grain]]
position = [0, 0.02, "50 mm"]
[[grain]]
position = [0, 0, "1 m"]
[[exit]]
low = [-1, -1, -1]
high = [1, 1, 0]
[run]
duration = "0.12 s"
step = 1e-5
)";

std::vector<double> column(const std::filesystem::path& file, const char* name) {
    const auto table = read_measures(file);
    if (!table) return {};
    for (std::size_t k = 0; k < table->columns().size(); ++k)
        if (table->columns()[k] == name) return table->values(k, 0, table->rows());
    return {};
}

TEST(ExitOfGrains, OutflowSaysWhoLeftAndWhen) {
    const TemporaryFolder here;
    write_text(here / "falling.toml", falling);
    const Ended ended =
        run_program({"movie", "falling.toml", "--out", "run", "--no-film"}, {.folder = here.path()});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const std::vector<double> times = column(here / "run/outflow.csv", "time_s");
    ASSERT_EQ(times.size(), 3u);
    const std::vector<double> ids = column(here / "run/outflow.csv", "id");
    const double fallen[] = {0.01, 0.03, 0.05}, who[] = {1, 0, 2};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(times[i], std::sqrt(2 * fallen[i] / 10), 3e-5) << i;
        EXPECT_EQ(ids[i], who[i]) << i;
    }
    const Ended seen = run_program({"inspect", "run/final.csv"}, {.folder = here.path()});
    EXPECT_EQ(seen.status, 0) << "a table with fewer grains than the scene is whole: " << seen.err;
}

TEST(ExitOfGrains, ARunThatGoesOnHasTheSameFile) {
    const TemporaryFolder here;
    write_text(here / "falling.toml", falling);
    const auto run = [&](const std::vector<std::string>& words) {
        const Ended ended = run_program(words, {.folder = here.path()});
        ASSERT_EQ(ended.status, 0) << ended.err;
    };
    run({"movie", "falling.toml", "--out", "whole", "--no-film"});
    run({"movie", "falling.toml", "--out", "run", "--no-film", "--duration", "0.06"});
    ASSERT_EQ(column(here / "run/outflow.csv", "time_s").size(), 1u);
    run({"resume", "run", "--until", "0.12", "--no-film"});
    EXPECT_EQ(text_of(here / "run/outflow.csv"), text_of(here / "whole/outflow.csv"));
}

}  // namespace
}  // namespace grainreel
