// Tests of runs whose grains are crushed, but not so far that the run stops: they say so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/cli/mesh_scene.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;

// A plate sinks onto a ball on the floor. `lowest` is where it stops, in diameters of the ball above the
// floor.
std::string pressed_ball(double lowest) {
    const double diameter = 0.003, speed = 0.05, start = 1.02 * diameter;
    return SmallScene("gravity = 0\n")
        .more("[[species]]\nname = \"ball\"\ndiameter = 0.003\ndensity = 2500\n")
        .contacts("0.5", "0.2")
        .more("law = \"spring-dashpot\"\nstiffness = 2000\n")
        .box("40 mm", "20 mm", "80 mm")
        .more("[[grain]]\nposition = [0, 0, 0.00151]\n")
        .more(fmt::format("[[mesh]]\nname = \"press\"\nfile = \"plate.stl\"\nposition = [0, 0, {}]\n"
                          "velocity = [0, 0, {}]\n",
                          start, -speed))
        .lasts(fmt::format("{} s", (start - lowest * diameter) / speed))
        .more("overlap = 0.02\n[output]\nmeasures_interval = \"0.2 ms\"\n");
}

class Crushed : public testing::Test {
  protected:
    Ended run(const std::string& scene) {
        write_mesh_scene(here.path(), scene);
        return run_program({"movie", "plate.toml", "--no-film", "--out", "run"}, setting);
    }
    nlohmann::json record() const { return nlohmann::json::parse(text_of(here / "run/run.json")); }

    TemporaryFolder here;
    Program::Setting setting{here.path()};
};

// At 0.8 of a diameter it overlaps plate and floor by 0.2 of its radius each; 0.04 are planned.
TEST_F(Crushed, IsToldWithGrainAndTime) {
    const Ended ended = run(pressed_ball(0.8));
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err,
                tells({"grain 0 (ball)", "of the smaller radius", "0.04 are planned", "\"press\" moves"}));
    const nlohmann::json overlap = record()["engine"]["largest_overlap"];
    EXPECT_NEAR(overlap["share"].get<double>(), 0.2, 0.01);
    EXPECT_EQ(overlap["grain"], 0);
    EXPECT_GT(overlap["time_s"].get<double>(), 0.01);
    const std::string warning = record()["warnings"].dump();
    EXPECT_THAT(warning, testing::HasSubstr("grain 0 (ball)"));
    EXPECT_THAT(text_of(here / "run/report.html"), testing::HasSubstr("of the smaller radius at "));
    EXPECT_THAT(run_program({"inspect", "run", "--largest-overlap"}, setting).out,
                tells({"beyond the limit", "\"press\" moves"}));
    // The run may go on; then it is told of the whole run.
    const Ended resumed = run_program({"resume", "run", "--until", "0.0133 s", "--no-report"}, setting);
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_THAT(resumed.err, testing::HasSubstr("grain 0 (ball)"));
    EXPECT_GE(record()["engine"]["largest_overlap"]["share"], overlap["share"]);
}

TEST_F(Crushed, IsNotToldOfTheOverlapsThatArePlanned) {
    const Ended ended = run(pressed_ball(0.97));
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, testing::Not(testing::HasSubstr("smaller radius")));
    EXPECT_LT(record()["engine"]["largest_overlap"]["share"], 0.04);
}

}  // namespace
}  // namespace grainreel
