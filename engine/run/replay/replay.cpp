#include "engine/run/replay/replay.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/run/replay/checkpoint_ring.hpp"
#include "engine/start/restart.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

Scene started_from(const Scene& scene, const fs::path& checkpoint) {
    Scene there = scene;
    there.start = {};
    there.start.method = Start::Method::file;
    there.start.file = checkpoint.string();
    there.start.keep_clock = true;
    return there;
}

// From the last one that is whole.
Simulation nearest_checkpoint(const fs::path& run, const std::vector<KeptCheckpoint>& kept, std::int64_t step,
                              int threads) {
    std::optional<UserError> mistake;
    for (auto one = kept.rbegin(); one != kept.rend(); ++one) {
        if (one->step > step) continue;
        try {
            return run_of_checkpoint(one->file, threads);
        } catch (const UserError& error) {
            if (!mistake) mistake = error;
        }
    }
    if (mistake) throw *mistake;
    throw UserError(
        fmt::format("{}: has no checkpoint of step {} or before, so that it cannot be brought back there",
                    run.string(), step));
}

}  // namespace

Plan plan_of_run(const Scene& scene, const fs::path& run) {
    const std::vector<KeptCheckpoint> kept = kept_checkpoints(run);
    if (kept.empty())
        throw UserError(fmt::format(
            "{}: has no checkpoints, so that no moment can be brought back; ask for a kept moment "
            "with --no-replay, or run the scene again with output.checkpoints",
            run.string()));
    return make_plan(started_from(scene, kept.front().file));
}

Simulation run_of_checkpoint(const fs::path& checkpoint, int threads) {
    Scene scene = scene_of_checkpoint(checkpoint);
    // Instruments and fields see the run and change nothing of it.
    scene.output.instruments.clear();
    scene.wishes = {};
    scene.output.fields = {};
    return Simulation::at_checkpoint(scene, make_plan(scene), checkpoint, threads, false, true);
}

Simulation replayed(const fs::path& run, const std::vector<KeptCheckpoint>& kept, std::int64_t step,
                    int threads, const ReplayWatcher& watcher) {
    Simulation simulation = nearest_checkpoint(run, kept, step, threads);
    replay_on(simulation, step, watcher);
    return simulation;
}

void replay_on(Simulation& simulation, std::int64_t step, const ReplayWatcher& watcher) {
    constexpr std::chrono::duration<double> stretch(0.1);
    const std::int64_t from = simulation.step();
    std::int64_t steps = 8;  // at a time
    while (simulation.step() < step) {
        const auto start = std::chrono::steady_clock::now();
        simulation.advance(std::min(step, simulation.step() + steps));
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        if (took < stretch / 2) steps *= 2;
        if (took > stretch) steps = std::max<std::int64_t>(1, steps / 2);
        if (!watcher(static_cast<double>(simulation.step() - from) / static_cast<double>(step - from)))
            throw RunError("stopped before the moment was reached");
    }
}

}  // namespace grainreel
