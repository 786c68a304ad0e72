#include "engine/run/replay/replay.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/run_json.hpp"
#include "engine/run/replay/checkpoint_ring.hpp"
#include "engine/start/restart.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

// Loads the last usable checkpoint at or before `step`. If there is none, throws the error of the nearest
// one, which was tried first.
SimulatedBed nearest_checkpoint(const fs::path& run, const std::vector<KeptCheckpoint>& kept,
                                std::int64_t step, int threads) {
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
    throw UserError("{}: has no checkpoint of step {} or before, so that it cannot be brought back there",
                    run.string(), step);
}

// Goes on to a later step. Throws RunError as replayed() does.
void replay_on(SimulatedBed& simulation, std::int64_t step, const ReplayWatcher& watcher) {
    constexpr std::chrono::duration<double> stretch(0.1);
    const std::int64_t from = simulation.step();
    std::int64_t steps = 8;  // steps at a time
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

}  // namespace

Plan plan_of_run(const Scene& scene, const fs::path& run) {
    const std::vector<KeptCheckpoint> kept = kept_checkpoints(run);
    if (kept.empty())
        throw UserError(
            "{}: has no checkpoints, so that no moment can be brought back; ask for a kept moment "
            "with --no-replay, or run the scene again with output.checkpoints",
            run.string());
    // The file that a run started from may be gone; its first checkpoint has the same grains. Other runs
    // expect the impacts that they expected when they began.
    if (scene.start.method == Start::Method::file) return make_plan(continued(scene, kept.front().file));
    Scene there = scene;
    there.start.keep_clock = true;
    Plan plan = make_plan(there);
    plan.start.text = "goes on at its step";
    return plan;
}

SimulatedBed run_of_checkpoint(const fs::path& checkpoint, int threads) {
    Scene scene = scene_of_checkpoint(checkpoint);
    // Instruments and fields observe the run and do not change it.
    scene.output.instruments.clear();
    scene.wishes = {};
    scene.output.fields = {};
    return SimulatedBed::at_checkpoint(scene, make_plan(scene), checkpoint, threads, false, true);
}

SimulatedBed replayed(const fs::path& run, const std::vector<KeptCheckpoint>& kept, std::int64_t step,
                      int threads, const ReplayWatcher& watcher) {
    SimulatedBed simulation = nearest_checkpoint(run, kept, step, threads);
    replay_on(simulation, step, watcher);
    return simulation;
}

Replayer::Replayer(std::filesystem::path run, std::vector<KeptCheckpoint> kept, int threads)
    : run_(std::move(run)), checkpoints_(std::move(kept)), threads_(threads) {}

bool Replayer::reaches(std::int64_t step) const {
    return !checkpoints_.empty() && checkpoints_.front().step <= step;
}

bool Replayer::goes_to(std::int64_t step) const {
    return reaches(step) && std::none_of(checkpoints_.begin(), checkpoints_.end(),
                                         [&](const KeptCheckpoint& one) { return one.step == step; });
}

bool Replayer::is_shortcut(std::int64_t from, std::int64_t to) const {
    return std::any_of(checkpoints_.begin(), checkpoints_.end(),
                       [&](const KeptCheckpoint& one) { return one.step > from && one.step <= to; });
}

SimulatedBed& Replayer::at(std::int64_t step, const ReplayWatcher& watcher) {
    const bool goes_on =
        simulation_ && simulation_->step() <= step && !is_shortcut(simulation_->step(), step);
    if (goes_on) {
        replay_on(*simulation_, step, watcher);
    } else {
        simulation_.reset();  // frees its memory before the next one is made
        simulation_.emplace(replayed(run_, checkpoints_, step, threads_, watcher));
    }
    return *simulation_;
}

namespace fs = std::filesystem;

namespace {

constexpr const char* kDamaged = "is damaged, or of another version of grainreel";

// The checkpoint's scene as this version would write it. Keys that an earlier version did not know get their
// defaults. Returns `kept`, the text as it was written, if the scene cannot be read.
std::string meant_today(const fs::path& checkpoint, const std::string& kept) {
    try {
        const Scene scene = scene_of_checkpoint(checkpoint);
        return scene_to_keep(scene, make_plan(scene));
    } catch (const UserError&) {
        return kept;
    }
}

std::string value_text(const std::string& value) {
    return value.empty() ? "not there" : excerpt(value);
}

// The reason why a checkpoint does not belong to the run with this scene; empty if it does.
std::string why_not(const KeptCheckpoint& one, const std::string& today,
                    const std::vector<AcceptedKey>& accepted) {
    const std::optional<CheckpointLabel> label = label_of_checkpoint(one.file);
    if (!label) return kDamaged;
    if (label->step != one.step)
        return fmt::format("is of another moment, step {}, than its name says", label->step);
    std::vector<KeyDifference> different = differences_of_future(label->scene, today, one.step, accepted);
    if (!different.empty())
        different = differences_of_future(meant_today(one.file, label->scene), today, one.step, accepted);
    if (different.empty()) return "";
    const KeyDifference& first = different.front();
    return fmt::format("is of another run: '{}' is {} there, but {} in scene.toml", excerpt(first.key),
                       value_text(first.then), value_text(first.now));
}

// Checkpoints that do not count, and why. Those of one reason are told in one line.
class PassedOver {
  public:
    void add(const fs::path& file, const std::string& why) {
        if (alike_.empty() || alike_.back().why != why) alike_.push_back({file, why, 0});
        ++alike_.back().count;
    }

    void tell(std::vector<std::string>& news) const {
        for (const Alike& some : alike_)
            news.push_back(some.count == 1
                               ? fmt::format("{}: {}; it is passed over", some.first.string(), some.why)
                               : fmt::format("{} and {} more checkpoints: each {}; they are passed over",
                                             some.first.string(), some.count - 1, some.why));
    }

  private:
    struct Alike {
        fs::path first;
        std::string why;
        int count;
    };
    std::vector<Alike> alike_;
};

}  // namespace

std::vector<KeptCheckpoint> own_checkpoints(const fs::path& run, const Scene& scene,
                                            std::vector<std::string>& news) {
    std::vector<KeptCheckpoint> own;
    PassedOver passed_over;
    std::vector<KeptCheckpoint> all = kept_checkpoints(run);
    if (const fs::path last = run / "checkpoint.grs"; is_there(last) && !label_of_checkpoint(last))
        passed_over.add(last, kDamaged);
    if (all.empty()) {
        passed_over.tell(news);
        return own;
    }
    const std::string today = scene_to_keep(scene, plan_of_run(scene, run));
    const std::vector<AcceptedKey> accepted = read_run_json(run / "run.json").record.accepted;
    for (KeptCheckpoint& one : all) {
        const std::string why = why_not(one, today, accepted);
        why.empty() ? own.push_back(std::move(one)) : passed_over.add(one.file, why);
    }
    // The last checkpoint says how far the run has come, so it must be whole.
    while (!own.empty() && !is_whole_checkpoint(own.back().file)) {
        passed_over.add(own.back().file, kDamaged);
        own.pop_back();
    }
    passed_over.tell(news);
    return own;
}

}  // namespace grainreel
