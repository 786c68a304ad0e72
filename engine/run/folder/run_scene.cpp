#include "engine/run/folder/run_scene.hpp"

#include <cmath>
#include <csignal>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/run/folder/scene_folder_run.hpp"
#include "engine/run/simulation/simulation.hpp"

namespace grainreel {

namespace {

std::vector<std::int64_t> steps_to_look_at(const Plan& plan, const RunSceneOptions& how) {
    std::vector<std::int64_t> steps;
    if (!(how.every > 0) || !how.look) return steps;
    const double every = std::max(how.every, plan.clock.step);
    const auto step = [&](std::int64_t k) {
        return std::llround(static_cast<double>(k) * every / plan.clock.step);
    };
    for (std::int64_t k = 0; step(k) <= plan.steps; ++k)
        if (steps.empty() || step(k) > steps.back()) steps.push_back(step(k));
    return steps;
}

class Stoppable final : public SilentListener {
  public:
    void stop() { signal_ = SIGINT; }
    int stop_signal() const override { return signal_; }

  private:
    int signal_ = 0;
};

class LookedAt final : public SceneFolderRun {
  public:
    LookedAt(const RunRequest& request, Stoppable& listener, const Scene& scene, const Plan& plan,
             const RunSceneOptions& how)
        : SceneFolderRun(request, listener, scene, plan), listener_(listener), how_(how) {}

  private:
    void start() override {
        FrameWishes wishes;
        wishes.steps = steps_to_look_at(driver_.plan(), how_);
        driver_.start(std::move(wishes));
    }
    bool next(const RunDriver::GoOn& go_on) override {
        const std::shared_ptr<Frame> frame = driver_.next(go_on);
        if (frame && !how_.look(*frame)) listener_.stop();
        return frame && listener_.stop_signal() == 0;
    }

    Stoppable& listener_;
    const RunSceneOptions& how_;
};

SceneEnd run_in_folder(const Scene& scene, const Plan& plan, const RunSceneOptions& how) {
    RunRequest request;
    request.out = how.folder;
    Stoppable listener;
    LookedAt run(request, listener, scene, plan, how);
    run.run();
    if (run.failure().any()) throw RunError(run.failure().what());
    return {run.simulation().frame(), listener.stop_signal() == 0};
}

SceneEnd run_in_memory(const Scene& scene, const Plan& plan, const RunSceneOptions& how) {
    Simulation simulation(scene, plan, engine_threads(scene));
    simulation.pack();
    for (const std::int64_t step : steps_to_look_at(plan, how)) {
        if (step < simulation.step()) continue;
        simulation.advance(step);
        if (!how.look(simulation.frame())) return {simulation.frame(), false};
    }
    simulation.advance(plan.steps);
    return {simulation.frame(), true};
}

}  // namespace

SceneEnd run_scene(const Scene& scene, const RunSceneOptions& how) {
    Scene there = scene;
    if (how.threads > 0) there.run.threads = how.threads;
    const Plan plan = make_plan(there);
    return how.folder.empty() ? run_in_memory(there, plan, how) : run_in_folder(there, plan, how);
}

}  // namespace grainreel
