// Tests of scenes that are run in a folder with the engine alone, without a film.
#include "engine/run/folder/scene_job.hpp"

#include <gtest/gtest.h>

#include <csignal>

#include "engine/files/run_json.hpp"
#include "engine/files/run_names.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/measure/columns.hpp"
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

// Asks the run to stop once it has come to a time.
class StopsAt : public SilentListener {
  public:
    explicit StopsAt(double time) : time_(time) {}
    void progress(const Progress& progress) override {
        if (progress.stage == Progress::Stage::vibrating && progress.time > time_) signal_ = SIGINT;
    }
    int stop_signal() const override { return signal_; }

  private:
    double time_ = 0;
    int signal_ = 0;
};

State end_of_run(const std::filesystem::path& folder, Listener& listener) {
    const Scene scene = fifty();
    JobRequest request;
    request.out = folder;
    SceneJob run(request, listener, scene, make_plan(scene));
    run.run();
    return run.simulation().frame();
}

std::string status_of(const std::filesystem::path& folder) {
    return read_run_json(folder / "run.json").status;
}

TEST(SceneJob, WritesTheFilesOfARunWithoutAFilm) {
    const TemporaryFolder here;
    SilentListener listener;
    EXPECT_EQ(end_of_run(here / "run", listener).size(), 50u);
    EXPECT_EQ(status_of(here / "run"), "complete");
    EXPECT_EQ(TrajectoryReader(here / "run/trajectory.nc").info().species.size(), 2u);
    EXPECT_FALSE(std::filesystem::exists(here / "run" / kFilmMoments));
}

// The run is continued as `resume` does it, but without a film.
TEST(SceneJob, GoesOnInItsFolder) {
    const TemporaryFolder here;
    const std::filesystem::path folder = here / "run";
    StopsAt stops(0.02);
    EXPECT_LT(end_of_run(folder, stops).time, 0.04);
    EXPECT_EQ(status_of(folder), "interrupted");

    const Scene scene = fifty();
    const Plan plan = make_plan(scene);
    JobRequest request;
    request.out = folder;
    auto lock = std::make_shared<FolderLock>(std::move(*FolderLock::take(folder, "")));
    SilentListener listener;
    SceneJob run(request, listener, scene, plan, find_resume_point(scene, plan, folder, 1), lock);
    EXPECT_EQ(run.run().exit_status, 0);
    EXPECT_EQ(run.simulation().frame().position, end_of_run(here / "whole", listener).position);
    EXPECT_EQ(status_of(folder), "complete");
}

}  // namespace
}  // namespace grainreel
