// A run goes on from the engine's restart file nearly as if it had not been broken off. Skipped where an
// engine is not installed.
#include <chrono>
#include <map>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/handover/back/dump_tail.hpp"
#include "engine/handover/back/trim_dump.hpp"
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

constexpr const char* turning_box = R"(
[[species]]
name = "ball"
count = 60
diameter = "3 mm"
density = 2500
[contact]
law = "spring-dashpot"
friction_law = "linear-spring"
stiffness = 300
restitution = 0.7
[container]
shape = "box"
width = "24 mm"
depth = "15 mm"
height = "24 mm"
turn = { axis = [1, 0, 0], through = [0, 0, 0.012], rate = "60 rpm" }
[output]
trajectory_interval = "10 ms"
[run]
duration = "0.2 s"
step = 4e-5
)";

std::map<std::int64_t, DumpRows> frames(const std::filesystem::path& file) {
    std::map<std::int64_t, DumpRows> all;
    DumpTail dump(file);
    while (std::optional<DumpRows> rows = dump.next()) all[rows->step] = std::move(*rows);
    return all;
}

void run(EngineJob job, const std::filesystem::path& folder) {
    job.start(folder);
    while (job.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(job.failure(), "");
}

class EngineGoesOn : public testing::TestWithParam<PeerEngine> {};

TEST_P(EngineGoesOn, FromItsRestartFile) {
    const PeerEngine engine = GetParam();
    const char* const program = engine == PeerEngine::lammps ? "lmp" : "liggghts";
    if (program_named(program).empty() || program_named("mpirun").empty())
        GTEST_SKIP() << program << " or mpirun is not installed";
    const TemporaryFolder folder;
    const Scene scene = read_scene_text(turning_box, folder / "scene.toml");
    CarryRequest request;
    request.engine = engine;
    CarriedScene carried = carry(scene, make_plan(scene), request);
    throw_refusals(carried);
    const StartState start = start_state(carried, 1, [](const PackingProgress&) { return true; });
    if (engine == PeerEngine::liggghts) make_room_for_walls(carried);
    write_handover(folder.path(), carried, start, "test");
    run(EngineJob(engine, 1, deck_name(engine)), folder.path());
    const auto dump = folder / dump_name(engine);
    const auto whole = frames(dump);
    EXPECT_EQ(newest_restart(folder.path(), engine), 5000);

    trim_dump(dump, 3000);
    EXPECT_EQ(frames(dump).rbegin()->first, 3000);
    run(EngineJob(engine, 1, deck_name(engine), fmt::format("{}.3000", restart_name(engine))), folder.path());
    const auto again = frames(dump);
    ASSERT_EQ(again.size(), whole.size());
    // Both begin with forces of dashpots at another velocity than within a step, and LIGGGHTS forgets
    // contacts with walls. A wall that had not turned would be millimetres off.
    constexpr double near = 5e-5;  // m
    const DumpRows &then = whole.at(3250), &now = again.at(3250);
    for (std::size_t i = 0; i < then.size(); ++i)
        EXPECT_NEAR((then.position[i] - now.position[i]).norm(), 0, near) << i;
}

INSTANTIATE_TEST_SUITE_P(Both, EngineGoesOn, testing::Values(PeerEngine::lammps, PeerEngine::liggghts),
                         [](const auto& engine) { return std::string(key_of(engine.param)); });

}  // namespace
}  // namespace grainreel::test
