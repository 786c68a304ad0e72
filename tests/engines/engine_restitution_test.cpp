// Two grains that meet, and grains that meet a wall, run by the other engines with the decks that we write:
// the restitution of each pair is the scene's. Skipped where an engine is not installed.
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/handover/decks/decks.hpp"
#include "engine/handover/peer_process.hpp"
#include "tests/engines/handed.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {
namespace {

// Ids 0 to 7: AA, AB, BB head on along y; A and B against the floor.
std::string scene_text(double speed, const std::string& law) {
    std::string text = SmallScene("gravity = 0\n")
                           .beads(0, "A", "2 mm", "2.5 g/cm3")
                           .beads(0, "B", "6 mm", "2.5 g/cm3")
                           .more("[contact]\nfriction = 0.3\n")
                           .text() +
                       law + R"(
[[contact.pair]]
between = ["A", "A"]
restitution = 0.9
[[contact.pair]]
between = ["A", "B"]
restitution = 0.8
[[contact.pair]]
between = ["B", "B"]
restitution = 0.7
[[contact.pair]]
between = ["A", "wall"]
restitution = 0.6
[[contact.pair]]
between = ["B", "wall"]
restitution = 0.5
[container]
shape = "box"
width = "120 mm"
depth = "120 mm"
height = "60 mm"
)";
    const auto grain = [&](const char* species, double x, double y, double z, double vy, double vz) {
        text += fmt::format("[[grain]]\nspecies = \"{}\"\nposition = [{}, {}, {}]\nvelocity = [0, {}, {}]\n",
                            species, x, y, z, vy, vz);
    };
    grain("A", -0.04, 0, 0.03, speed, 0);
    grain("A", -0.04, 0.0021, 0.03, 0, 0);
    grain("A", -0.02, 0, 0.03, speed, 0);
    grain("B", -0.02, 0.0041, 0.03, 0, 0);
    grain("B", 0, 0, 0.03, speed, 0);
    grain("B", 0, 0.0061, 0.03, 0, 0);
    grain("A", 0.02, 0.0, 0.0011, 0, -speed);
    grain("B", 0.04, 0.0, 0.0031, 0, -speed);
    return text + "[run]\nduration = 0.004\nstep = 2e-7\n[output]\ntrajectory_interval = \"1 ms\"\n";
}

struct Impacts {
    double aa = 0, ab = 0, bb = 0, a_wall = 0, b_wall = 0;
};

Impacts impacts(PeerEngine engine, double speed, const std::string& law) {
    const TemporaryFolder folder;
    CarryRequest request;
    request.engine = engine;
    request.accept_law = true;  // of the tangential law, which is of no matter here
    hand_over(scene_text(speed, law), request, folder.path());
    EXPECT_EQ(run_engine(PeerProcess(engine, 1, deck_name(engine)), folder.path()), "");
    const auto frames = frames_of(engine, folder.path());
    if (frames.empty() || frames.rbegin()->second.size() != 8) return {};
    const State& last = frames.rbegin()->second;
    const auto apart = [&](std::size_t k) { return (last.velocity[k + 1] - last.velocity[k]).y() / speed; };
    return {apart(0), apart(2), apart(4), last.velocity[6].z() / speed, last.velocity[7].z() / speed};
}

// found(e) is what a pair of restitution e in the scene should have.
template <class Found>
void expect_impacts(const Impacts& e, const Found& found) {
    constexpr double near = 0.003;
    EXPECT_NEAR(e.aa, found(0.9), near);
    EXPECT_NEAR(e.ab, found(0.8), near);
    EXPECT_NEAR(e.bb, found(0.7), near);
    EXPECT_NEAR(e.a_wall, found(0.6), near);
    EXPECT_NEAR(e.b_wall, found(0.5), near);
}

class EngineRestitution : public testing::TestWithParam<PeerEngine> {
  protected:
    void SetUp() override { NEEDS_ENGINE(GetParam()); }
};

// LAMMPS has no such law.
class LudingRestitution : public EngineRestitution {};
// LIGGGHTS takes a modulus of each material, not of a pair.
class HertzRestitution : public EngineRestitution {};

TEST_P(EngineRestitution, OfAllPairsAndWallsIsTheScenes) {
    expect_impacts(impacts(GetParam(), 0.5,
                           "law = \"spring-dashpot\"\nfriction_law = \"linear-spring\"\nstiffness = 1e4"),
                   [](double e) { return e; });
}

TEST_P(EngineRestitution, HoldsWithDashpotsThatPull) {
    expect_impacts(impacts(GetParam(), 0.5, "law = \"spring-dashpot\"\nstiffness = 1e4\nattraction = true"),
                   [](double e) { return e; });
}

TEST_P(HertzRestitution, HoldsWithAndWithoutPulling) {
    for (const char* pull : {"", "\nattraction = true"}) {
        SCOPED_TRACE(pull);
        expect_impacts(impacts(GetParam(), 0.5, fmt::format("law = \"hertz\"\nmodulus = 2e7{}", pull)),
                       [](double e) { return e; });
    }
}

// Walton and Braun's law with K2 = K1 + S F_max has e = 1 / sqrt(1 + S v sqrt(m / K1)): at half the speed
// where it is e0 it is 1 / sqrt(1 + (1 / e0^2 - 1) / 2).
TEST_P(LudingRestitution, FallsWithSpeed) {
    expect_impacts(
        impacts(GetParam(), 0.25,
                "law = \"walton-braun\"\nfriction_law = \"linear-spring\"\nrestitution_speed = 0.5\n"
                "stiffness = 1e4"),
        [](double e0) { return 1 / std::sqrt(1 + (1 / (e0 * e0) - 1) / 2); });
}

// LIGGGHTS opens a log in the folder where it is, whatever it is asked.
TEST_P(EngineRestitution, AskingForTheVersionLeavesNoFile) {
    const TemporaryFolder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    const EngineProgram program = find_engine(GetParam());
    std::filesystem::current_path(before);
    EXPECT_NE(program.version, "");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

const auto name_of_engine = [](const auto& engine) { return std::string(key_of(engine.param)); };
INSTANTIATE_TEST_SUITE_P(Both, EngineRestitution, testing::Values(PeerEngine::lammps, PeerEngine::liggghts),
                         name_of_engine);
INSTANTIATE_TEST_SUITE_P(Lammps, HertzRestitution, testing::Values(PeerEngine::lammps), name_of_engine);
INSTANTIATE_TEST_SUITE_P(Liggghts, LudingRestitution, testing::Values(PeerEngine::liggghts), name_of_engine);

}  // namespace
}  // namespace grainreel::test
