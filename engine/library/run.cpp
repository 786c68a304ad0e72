// The library's run(): a scene from its beginning to its end, in memory or with the files of a run.
#include "engine/library/internal.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <utility>

#include "engine/run/folder/scene_job.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "grainreel/run.hpp"

namespace grainreel::v1 {
namespace {

std::vector<std::int64_t> steps_to_look_at(const Plan& plan, const RunOptions& options) {
    std::vector<std::int64_t> steps;
    if (!(options.every > 0) || !options.look) return steps;
    const double every = std::max(options.every, plan.clock.step);
    const auto step = [&](std::int64_t k) {
        return std::llround(static_cast<double>(k) * every / plan.clock.step);
    };
    for (std::int64_t k = 0; step(k) <= plan.steps; ++k)
        if (steps.empty() || step(k) > steps.back()) steps.push_back(step(k));
    return steps;
}

// Gives frames to options.look(), and stops the run when that returns false. An exception is kept here,
// because a run in a folder would turn it into a RunError.
class Looker final : public SilentListener {
  public:
    explicit Looker(const RunOptions& options) : options_(options) {}
    void look(const grainreel::State& now) {
        try {
            if (!options_.look(outside(now))) stopped_ = true;
        } catch (...) {
            thrown_ = std::current_exception();
            stopped_ = true;
        }
    }
    bool stopped() const { return stopped_; }
    int stop_signal() const override { return stopped_ ? SIGINT : 0; }
    void rethrow() const {
        if (thrown_) std::rethrow_exception(thrown_);
    }

  private:
    const RunOptions& options_;
    bool stopped_ = false;
    std::exception_ptr thrown_;
};

class LookedAt final : public SceneJob {
  public:
    LookedAt(const JobRequest& request, Looker& looker, const grainreel::Scene& scene, const Plan& plan,
             std::vector<std::int64_t> steps)
        : SceneJob(request, looker, scene, plan), looker_(looker), steps_(std::move(steps)) {}

  private:
    void start() override {
        FilmWishes wishes;
        wishes.steps = steps_;
        driver_.start(std::move(wishes));
    }
    bool next(const RunDriver::GoOn& go_on) override {
        const std::shared_ptr<grainreel::State> frame = driver_.next(go_on);
        if (frame) looker_.look(*frame);
        return frame && !looker_.stopped();
    }

    Looker& looker_;
    std::vector<std::int64_t> steps_;
};

Frame run_in_folder(const grainreel::Scene& scene, const Plan& plan, const RunOptions& options,
                    Looker& looker) {
    JobRequest request;
    request.out = options.folder;
    LookedAt run(request, looker, scene, plan, steps_to_look_at(plan, options));
    run.run();
    if (run.failure().any()) throw RunError(run.failure().what());
    return outside(run.simulation().frame());
}

Frame run_in_memory(const grainreel::Scene& scene, const Plan& plan, const RunOptions& options,
                    Looker& looker) {
    grainreel::SimulatedBed simulation(scene, plan, engine_threads(scene));
    simulation.pack();
    for (const std::int64_t step : steps_to_look_at(plan, options)) {
        if (step < simulation.step()) continue;
        simulation.advance(step);
        looker.look(simulation.frame());
        if (looker.stopped()) return outside(simulation.frame());
    }
    simulation.advance(plan.steps);
    return outside(simulation.frame());
}

}  // namespace

RunEnd run(const Scene& scene, const RunOptions& options) {
    check_threads(options.threads);
    if (!std::isfinite(options.every) || options.every < 0) throw Error("every: must be at least 0 s");
    grainreel::Scene with_threads = scene.impl().scene;
    if (options.threads > 0) with_threads.run.threads = options.threads;
    Looker looker(options);
    Frame last = told([&] {
        const Plan plan = make_plan(with_threads);
        return options.folder.empty() ? run_in_memory(with_threads, plan, options, looker)
                                      : run_in_folder(with_threads, plan, options, looker);
    });
    looker.rethrow();
    return {std::move(last), !looker.stopped()};
}

}  // namespace grainreel::v1
