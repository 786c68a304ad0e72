#include "engine/questions/asked_run.hpp"

#include <fmt/format.h>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/run/replay/replay.hpp"
#include "engine/state/checkpoint_file.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// The clock of the frames, with the scene's own step where the scene gives one. The frames tell the step only
// up to rounding, and a moment at step 0 does not tell it at all.
Clock clock_of_frames(const Scene& scene, const FrameArchive& frames) {
    Clock clock = clock_of(scene, frames.moments());
    if (scene.run.step) clock.step = *scene.run.step;
    return clock;
}

}  // namespace

AskedRun::AskedRun(std::shared_ptr<const FrameArchive> frames)
    : frames_(std::move(frames)),
      scene_(frames_->scene() ? *frames_->scene() : scene_of(frames_->world())),
      clock_(clock_of_frames(scene_, *frames_)) {}

AskedRun::AskedRun(std::shared_ptr<const RunArchive> run)
    : frames_(run), run_(run.get()), scene_(*run->scene()), clock_(run->clock()) {}

std::vector<std::string> AskedRun::faults() const {
    return run_ ? run_->faults() : std::vector<std::string>();
}

const OwnCheckpoints& AskedRun::own() const {
    if (own_) return *own_;
    own_.emplace();
    std::error_code error;
    const fs::path& path = frames_->path();
    if (run_)
        own_ = own_checkpoints(path, scene_);
    else if (is_checkpoint(path))
        own_->kept = {{moments().front().step, path, fs::file_size(path, error)}};
    return *own_;
}

Frame AskedRun::frame(std::size_t index) const {
    Frame frame = frames_->grains(index);
    if (std::optional<std::vector<Touch>> touches = frames_->touches(index))
        frame.touches = std::move(*touches);
    return frame;
}

RestoredCheckpoint::RestoredCheckpoint(const fs::path& file) : RestoredCheckpoint(file, restore(file)) {}

RestoredCheckpoint::RestoredCheckpoint(const fs::path& file, Restored restored)
    : AskedRun(std::shared_ptr<const FrameArchive>(open_frames(file, {.format = "checkpoint"}))),
      restored_(std::move(restored)) {}

RestoredCheckpoint::Restored RestoredCheckpoint::restore(const fs::path& file) {
    const Simulation run = run_of_checkpoint(file, 1);
    Frame frame = run.frame();
    MeasuredRow measured{frame.time, run.measured(), run.measures().values()};
    return {std::move(frame), std::move(measured)};
}

namespace {

namespace fs = std::filesystem;

constexpr double same_place = 1e-4;  // as a share of a grain's radius

std::vector<Touch> touches_of(const Simulation& run) {
    std::vector<Touch> touches;
    for (const SavedContact& one : run.contacts()) touches.push_back({one.first, one.second, one.normal});
    return touches;
}

}  // namespace

ReachableMoments::ReachableMoments(const AskedRun& run, int threads) : run_(run) {
    look_again();
    if (threads > 0) replayer_.emplace(run.frames().path(), run.checkpoints(), threads);
    for (const KeptList::Fault& fault : kept_->faults_of_film())
        news_.push_back(fmt::format("{}; it is not used", fault.what));
}

std::optional<std::size_t> ReachableMoments::kept_at(std::int64_t step, bool touches) const {
    const std::optional<std::size_t> index = kept_->find(step);
    const bool enough =
        index && (!touches || (kept_->place_of(*index).trajectory && run_.frames().supply().contacts));
    return enough ? index : std::nullopt;
}

ReachableMoments::Place ReachableMoments::place_of(std::int64_t step, bool touches) const {
    if (const auto index = kept_at(step, touches))
        return kept_->place_of(*index).trajectory ? Place::trajectory : Place::film_moments;
    if (replayer_ && replayer_->reaches(step)) return Place::checkpoints;
    return Place::nowhere;
}

ReachableMoments::Found ReachableMoments::at(std::int64_t step, bool touches, const ReplayWatcher& watcher) {
    std::optional<DamagedFrame> damage;
    if (const auto index = kept_at(step, touches)) {
        try {
            return {kept_->grains(*index), false};
        } catch (const DamagedFrame& problem) {
            damage = problem;
        }
    }
    if (replayer_ && replayer_->reaches(step)) {
        prove(step, watcher);
        const Simulation& run = replayer_->at(step, watcher);
        Found found{run.frame(), true};
        if (touches) found.frame.touches = touches_of(run);
        return found;
    }
    if (damage) throw *damage;
    throw UserError(fmt::format("{}: {:.6g} s was not kept, and cannot be brought back",
                                run_.frames().path().string(), run_.clock().time(step)));
}

void ReachableMoments::prove(std::int64_t step, const ReplayWatcher& watcher) {
    if (proven_ || !replayer_) return;
    const std::vector<Frame>& moments = run_.moments();
    for (std::size_t k = moments.size(); k-- > 0;) {
        if (moments[k].step > step || !replayer_->goes_to(moments[k].step)) continue;
        try {
            const Frame kept = run_.frames().grains(k);
            proven_ = same_grains(kept, replayer_->at(moments[k].step, watcher).frame());
        } catch (const DamagedFrame&) {
            continue;
        }
        if (proven_) return;
        throw UserError(fmt::format(
            "{}: brought back to {:.6g} s it has other grains than in trajectory.nc: its checkpoints are of "
            "another run, or do not hold all of it; --no-replay draws what was kept",
            run_.frames().path().string(), moments[k].time));
    }
}

bool ReachableMoments::brings_all_back() const {
    return replayer_ && replayer_->reaches(run_.moments().front().step);
}

}  // namespace grainreel
