#include "engine/replay/replay.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/replay/checkpoint_ring.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

// Instruments and fields see the run and change nothing of it.
Scene without_instruments(const Scene& scene) {
    Scene bare = scene;
    bare.output.instruments.clear();
    bare.output.fields = {};
    return bare;
}

// From the last one that is whole.
Simulation nearest_checkpoint(const Scene& scene, const Plan& plan, const fs::path& run, std::int64_t step,
                              int threads) {
    const std::vector<KeptCheckpoint> kept = kept_checkpoints(run);
    std::optional<UserError> mistake;
    for (auto one = kept.rbegin(); one != kept.rend(); ++one) {
        if (one->step > step) continue;
        try {
            return Simulation::at_checkpoint(scene, plan, one->file, threads);
        } catch (const UserError& error) {
            if (!mistake) mistake = error;
        }
    }
    if (mistake) throw *mistake;
    throw UserError(fmt::format(
        "{}: has no checkpoint of {:.6g} s or before, so that this moment cannot be brought back; ask for a "
        "kept moment with --no-replay, or run the scene again with output.checkpoints",
        run.string(), plan.clock.time(step)));
}

}  // namespace

Plan plan_of_run(const Scene& scene, const fs::path& run) {
    const std::vector<KeptCheckpoint> kept = kept_checkpoints(run);
    if (kept.empty())
        throw UserError(fmt::format(
            "{}: has no checkpoints, so that no moment can be brought back; ask for a kept moment "
            "with --no-replay, or run the scene again with output.checkpoints",
            run.string()));
    Scene there = scene;
    there.start = {};
    there.start.method = Start::Method::file;
    there.start.file = kept.front().file.string();
    there.start.keep_clock = true;
    return make_plan(there);
}

Simulation replayed(const Scene& scene, const Plan& plan, const fs::path& run, std::int64_t step, int threads,
                    const ReplayWatcher& watcher) {
    constexpr std::chrono::duration<double> stretch(0.1);
    Simulation simulation = nearest_checkpoint(without_instruments(scene), plan, run, step, threads);
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
    return simulation;
}

}  // namespace grainreel
