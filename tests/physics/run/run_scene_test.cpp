// Tests of scenes that a program runs with the engine alone: in memory, and in a folder.
#include "engine/run/folder/run_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/files/run_json.hpp"
#include "engine/files/run_names.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/measure/columns.hpp"
#include "engine/run/folder/scene_folder_run.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using test::TemporaryFolder;

Scene fifty() {
    return read_scene_text(test::small_scene_text, "fifty.toml",
                           with_tested_precision({"start.settle_limit=0.02 s", "run.duration=0.05 s"}),
                           measurable_in);
}

TEST(RunScene, InAFolderAndInMemoryIsTheSameRun) {
    const TemporaryFolder here;
    RunSceneOptions how;
    const SceneEnd in_memory = run_scene(fifty(), how);
    how.folder = here / "run";
    const SceneEnd in_folder = run_scene(fifty(), how);
    EXPECT_TRUE(in_memory.complete && in_folder.complete);
    ASSERT_EQ(in_memory.frame.size(), 50u);
    EXPECT_NEAR(in_memory.frame.time, 0.05, 1e-4);
    EXPECT_EQ(in_memory.frame.position, in_folder.frame.position);
    EXPECT_EQ(status_in_run_json(how.folder / "run.json"), "complete");
    EXPECT_EQ(TrajectoryReader(how.folder / "trajectory.nc").info().species.size(), 2u);
    EXPECT_FALSE(std::filesystem::exists(how.folder / kFilmMoments));
}

TEST(RunScene, ShowsItsFramesAndStopsWhenToldTo) {
    const TemporaryFolder here;
    for (const std::filesystem::path& folder : {std::filesystem::path(), here / "run"}) {
        std::vector<double> times;
        RunSceneOptions how;
        how.folder = folder;
        how.every = 0.01;
        how.look = [&](const Frame& now) {
            times.push_back(now.time);
            return now.time < 0.025;
        };
        const SceneEnd end = run_scene(fifty(), how);
        EXPECT_FALSE(end.complete);
        EXPECT_THAT(times,
                    testing::Pointwise(testing::DoubleNear(1e-4), std::vector<double>{0, 0.01, 0.02, 0.03}));
        EXPECT_NEAR(end.frame.time, 0.03, 1e-4);
    }
    EXPECT_EQ(status_in_run_json(here / "run/run.json"), "interrupted");
}

TEST(RunScene, SaysWhatIsWrong) {
    const TemporaryFolder here;
    test::write_text(here / "notes.txt", "mine");
    RunSceneOptions how;
    how.folder = here.path();
    EXPECT_THROW(run_scene(fifty(), how), UserError);
    how.folder = here / "run";
    how.every = 0.01;
    how.look = [](const Frame&) -> bool { throw std::runtime_error("no more ink"); };
    try {
        run_scene(fifty(), how);
        FAIL();
    } catch (const RunError& problem) {
        EXPECT_STREQ(problem.what(), "no more ink");
    }
    EXPECT_EQ(status_in_run_json(how.folder / "run.json"), "failed");
}

// The run is continued as `resume` does it, but without a film.
TEST(RunScene, GoesOnInItsFolder) {
    const TemporaryFolder here;
    RunSceneOptions how;
    how.every = 0.02;
    how.look = [](const Frame& now) { return now.time < 0.01; };
    how.folder = here / "run";
    EXPECT_FALSE(run_scene(fifty(), how).complete);

    const Scene scene = fifty();
    const Plan plan = make_plan(scene);
    RunRequest request;
    request.out = how.folder;
    auto lock = std::make_shared<FolderLock>(std::move(*FolderLock::take(how.folder, "")));
    SilentListener listener;
    SceneFolderRun run(request, listener, scene, plan, find_resume_point(scene, plan, how.folder, 1), lock);
    EXPECT_EQ(run.run().exit_status, 0);
    const SceneEnd whole = run_scene(fifty());
    EXPECT_EQ(run.simulation().frame().position, whole.frame.position);
    EXPECT_EQ(status_in_run_json(how.folder / "run.json"), "complete");
}

}  // namespace
}  // namespace grainreel
