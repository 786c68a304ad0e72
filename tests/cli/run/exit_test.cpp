// Tests of grains that leave through an [[exit]]. They are in outflow.csv, as with an outlet, and a run that
// is continued keeps this file.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/files/measures_csv.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;

// Three balls fall freely from 10, 30 and 50 mm above the exit's upper side. A fourth one is too high to
// reach it.
const std::string falling = SmallScene("gravity = 10\n")
                                .beads(0, "ball")
                                .contacts("0.8", "0.3")
                                .more("stiffness = \"1000 N/m\"\n")
                                .empty_space()
                                .more("[[grain]]\nposition = [0, 0, \"30 mm\"]\n")
                                .more("[[grain]]\nposition = [0.02, 0, \"10 mm\"]\n")
                                .more("[[grain]]\nposition = [0, 0.02, \"50 mm\"]\n")
                                .more("[[grain]]\nposition = [0, 0, \"1 m\"]\n")
                                .more("[[exit]]\nlow = [-1, -1, -1]\nhigh = [1, 1, 0]\n")
                                .lasts("0.12 s")
                                .more("step = 1e-5\n")
                                .text();

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

// A bed of twenty grains in a box, of which some lie in the exit when they are packed.
const std::string bed_in_exit = SmallScene()
                                    .beads(20, "b", "5 mm", "1100")
                                    .box("60 mm", "20 mm", "80 mm")
                                    .more("[[exit]]\nlow = [-1, 0.015, -1]\nhigh = [1, 1, 1]\n")
                                    .more("[start]\nsettle_limit = \"0.3 s\"\n")
                                    .lasts("0.1")
                                    .more("accuracy = \"draft\"\n")
                                    .text();

// Three species that rain into a cylinder, with a feed and an outlet that opens at once.
const std::string rain_in_exit = R"([[species]]
name = "aa"
count = 6
diameter = { min = "4.154 mm", max = "6.773 mm" }
density = 500
[[species]]
name = "bb"
count = 20
diameter = { mean = "5.411 mm", deviation = "0.118 mm" }
density = 2500
[[species]]
name = "cc"
count = 3
diameter = { min = "1.893 mm", max = "2.317 mm" }
density = 1100
[contact]
law = "walton-braun"
restitution = 0.5
friction = inf
rolling_friction = 0.01
restitution_speed = 0.5
[container]
shape = "cylinder"
height = "108.8 mm"
diameter = "74.35 mm"
top = "open"
outlet = { diameter = "11.39 mm", opens = "0 s" }
[drive]
frequency = 15
g_level = 4
ramp = 3
[start]
method = "rain"
settle_limit = "0.4 s"
rain_rate = 2000
[[feed]]
species = "bb"
rate = 50
from = 0.03
[[exit]]
low = [-1, 0.0148707, 0.0169321]
high = [1, 1, 1]
[run]
duration = 0.1
seed = 429
accuracy = "draft"
[output]
instruments = ["energy_balance", "outflow", "walls"]
measures_interval = 0.005
trajectory_interval = 0.01
)";

class ExitAtStart : public testing::Test {
  protected:
    Ended ended(const std::vector<std::string>& words) const {
        return run_program(words, {.folder = here.path()});
    }
    std::string run(std::vector<std::string> words) const {
        const Ended end = ended(words);
        EXPECT_EQ(end.status, 0) << words[0] << ": " << end.err;
        return end.err;
    }
    std::string movie(const std::string& scene, const char* out, std::vector<std::string> more = {}) const {
        write_text(here / "scene.toml", scene);
        more.insert(more.begin(), {"movie", "scene.toml", "--no-film", "--no-report", "--out", out});
        return run(more);
    }
    std::size_t rows(const std::string& file, const char* name = "id") const {
        return column(here / file, name).size();
    }
    void expect_same(const std::string& one, const std::string& other) const {
        for (const char* file : {"outflow.csv", "final.csv", "measures.csv", "trajectory.nc"})
            EXPECT_EQ(text_of(here / one / file), text_of(here / other / file)) << file;
    }
    TemporaryFolder here;
};

TEST_F(ExitAtStart, EveryGrainIsInAFile) {
    const std::string said = movie(bed_in_exit, "run");
    EXPECT_EQ(rows("run/outflow.csv") + rows("run/final.csv"), 20u);
    const std::vector<double> times = column(here / "run/outflow.csv", "time_s");
    ASSERT_FALSE(times.empty());
    EXPECT_EQ(times.front(), 0);
    const auto at_once = static_cast<std::size_t>(std::count(times.begin(), times.end(), 0.0));
    EXPECT_THAT(said, HasSubstr(fmt::format("{} of 20 grains", at_once)));
    EXPECT_THAT(said, tells({"in an exit", "packed", "left at 0 s"}));
}

TEST_F(ExitAtStart, TheRunIsTheSameWhereverItWasStopped) {
    for (const std::string& scene : {bed_in_exit, rain_in_exit}) {
        movie(scene, "whole", {"--force"});
        for (const char* threads : {"1", "2", "3"}) {
            movie(scene, "run", {"--force", "--threads", threads, "--duration", "0.05"});
            run({"resume", "run", "--until", "0.1", "--threads", threads});
            expect_same("whole", "run");
        }
        ASSERT_GT(rows("whole/outflow.csv"), 0u);
        run({"inspect", "run", "--at", "0.055", "--largest-overlap"});
    }
}

TEST_F(ExitAtStart, AKeptPackingGivesTheSameRun) {
    movie(bed_in_exit, "whole");
    const Program::Setting keeps{here.path(),
                                 {"XDG_CACHE_HOME=" + (here / "cache").string(), "GRAINREEL_PACKINGS=all"}};
    for (const char* out : {"packs", "takes"}) {
        const Ended end =
            run_program({"movie", "scene.toml", "--no-film", "--no-report", "--out", out}, keeps);
        ASSERT_EQ(end.status, 0) << end.err;
        EXPECT_EQ(end.err.find("took the packing of an earlier run") != end.err.npos,
                  out == std::string("takes"));
        EXPECT_THAT(end.err, HasSubstr("left at 0 s"));
        expect_same("whole", out);
    }
}

// The table has gaps in its ids, because some grains have left.
TEST_F(ExitAtStart, AnotherRunMayStartFromItsFiles) {
    movie(bed_in_exit, "first");
    const std::size_t there = rows("first/final.csv");
    std::string text = bed_in_exit;
    const std::string packs = "settle_limit = \"0.3 s\"", count = "count = 20";
    text.replace(text.find(count), count.size(), fmt::format("count = {}", there));
    for (const char* file : {"final.csv", "checkpoint.grs"}) {
        std::string next = text;
        next.replace(next.find(packs), packs.size(),
                     fmt::format("method = \"file\"\nfile = \"first/{}\"", file));
        movie(next.c_str(), "next", {"--force"});
        EXPECT_EQ(rows("next/outflow.csv") + rows("next/final.csv"), there) << file;
    }
}

TEST_F(ExitAtStart, CheckSaysIt) {
    write_text(here / "scene.toml", bed_in_exit);
    const Ended end = ended({"check", "scene.toml"});
    EXPECT_EQ(end.status, 0) << end.err;
    EXPECT_THAT(end.out + end.err, HasSubstr("of 20 grains"));
    EXPECT_THAT(end.out + end.err, tells({"in an exit", "run begins", "leave at 0 s"}));
}

}  // namespace
}  // namespace grainreel
