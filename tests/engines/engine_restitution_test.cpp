// Two grains that meet, and grains that meet a wall, run by the other engines with the decks that we write:
// the restitution of each pair is the scene's. Skipped where an engine is not installed.
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/handover/back/dump_tail.hpp"
#include "engine/handover/carry.hpp"
#include "engine/handover/deck_parts.hpp"
#include "engine/handover/handover_folder.hpp"
#include "engine/handover/runner/engine_job.hpp"
#include "engine/handover/start_state.hpp"
#include "engine/handover/triangle_walls.hpp"
#include "engine/scene/file/reader.hpp"
#include "tests/cli/temporary_folder.hpp"

namespace grainreel::test {
namespace {

// Ids 0 to 7: AA, AB, BB head on along y; A and B against the floor.
std::string scene_text(double speed, const std::string& law) {
    std::string text = R"([[species]]
name = "A"
diameter = "2 mm"
density = "2.5 g/cm3"
[[species]]
name = "B"
diameter = "6 mm"
density = "2.5 g/cm3"
[contact]
)" + law + R"(
stiffness = 1e4
friction = 0.3
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
    text = "gravity = 0\n" + text;
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

Impacts run(PeerEngine engine, int ranks, double speed, const std::string& law) {
    const TemporaryFolder folder;
    const Scene scene = read_scene_text(scene_text(speed, law), folder / "scene.toml");
    CarryRequest request;
    request.engine = engine;
    request.ranks = ranks;
    request.accept_law = true;  // of the tangential law, which is of no matter here
    CarriedScene carried = carry(scene, make_plan(scene), request);
    throw_refusals(carried);
    const StartState start = start_state(carried, 1, [](const PackingProgress&) { return true; });
    if (engine == PeerEngine::liggghts) make_room_for_walls(carried);
    write_handover(folder.path(), carried, start, "test");
    EngineJob job(engine, ranks, deck_name(engine));
    job.start(folder.path());
    while (job.is_running()) continue;
    EXPECT_EQ(job.failure(), "");
    DumpTail dump(folder / dump_name(engine));
    std::optional<DumpRows> last;
    while (std::optional<DumpRows> rows = dump.next()) last = std::move(rows);
    if (!last || last->size() != 8) return {};
    const auto apart = [&](std::size_t k) { return (last->velocity[k + 1] - last->velocity[k]).y() / speed; };
    return {apart(0), apart(2), apart(4), last->velocity[6].z() / speed, last->velocity[7].z() / speed};
}

class EngineRestitution : public testing::TestWithParam<PeerEngine> {
  protected:
    void SetUp() override {
        const char* const program = GetParam() == PeerEngine::lammps ? "lmp" : "liggghts";
        if (program_named(program).empty() || program_named("mpirun").empty())
            GTEST_SKIP() << program << " or mpirun is not installed";
    }
};

class LudingRestitution : public EngineRestitution {};  // LAMMPS has no such law

constexpr double kNear = 0.003;

TEST_P(EngineRestitution, OfAllPairsAndWallsIsTheScenes) {
    const Impacts e = run(GetParam(), 1, 0.5, "law = \"spring-dashpot\"\nfriction_law = \"linear-spring\"");
    EXPECT_NEAR(e.aa, 0.9, kNear);
    EXPECT_NEAR(e.ab, 0.8, kNear);
    EXPECT_NEAR(e.bb, 0.7, kNear);
    EXPECT_NEAR(e.a_wall, 0.6, kNear);
    EXPECT_NEAR(e.b_wall, 0.5, kNear);
}

// Walton and Braun's law with K2 = K1 + S F_max has e = 1 / sqrt(1 + S v sqrt(m / K1)): at half the speed
// where it is e0 it is 1 / sqrt(1 + (1 / e0^2 - 1) / 2).
TEST_P(LudingRestitution, FallsWithSpeed) {
    const std::string law =
        "law = \"walton-braun\"\nfriction_law = \"linear-spring\"\nrestitution_speed = 0.5";
    const auto at_half = [](double e0) { return 1 / std::sqrt(1 + (1 / (e0 * e0) - 1) / 2); };
    const Impacts e = run(GetParam(), 1, 0.25, law);
    EXPECT_NEAR(e.aa, at_half(0.9), kNear);
    EXPECT_NEAR(e.ab, at_half(0.8), kNear);
    EXPECT_NEAR(e.bb, at_half(0.7), kNear);
    EXPECT_NEAR(e.a_wall, at_half(0.6), kNear);
    EXPECT_NEAR(e.b_wall, at_half(0.5), kNear);
}

INSTANTIATE_TEST_SUITE_P(Both, EngineRestitution, testing::Values(PeerEngine::lammps, PeerEngine::liggghts),
                         [](const auto& engine) { return std::string(key_of(engine.param)); });

INSTANTIATE_TEST_SUITE_P(Liggghts, LudingRestitution, testing::Values(PeerEngine::liggghts),
                         [](const auto& engine) { return std::string(key_of(engine.param)); });

}  // namespace
}  // namespace grainreel::test
