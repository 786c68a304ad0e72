#include "engine/questions/asked_run.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstdlib>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/same_run.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/run_names.hpp"
#include "engine/questions/snapshot.hpp"
#include "engine/run/replay/replay.hpp"
#include "engine/state/body.hpp"
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
    return frames_->grains(index);
}

void AskedRun::add_kept(std::size_t index, Snapshot& snapshot) const {
    snapshot.touches = frames_->touches(index).value_or(std::vector<Touch>());
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

bool same_grains(const Frame& a, const Frame& b) {
    bool same = a.id == b.id;
    for (std::size_t i = 0; same && i < a.size(); ++i)
        same = (a.position[i] - b.position[i]).norm() <= same_place * b.radius[i];
    return same;
}

}  // namespace

ReachableMoments::ReachableMoments(const AskedRun& run, int threads) : run_(run) {
    if (threads > 0) replayer_.emplace(run.frames().path(), run.checkpoints(), threads);
    read_film_moments();
    if (!filmed_.empty()) check_film_moments();
}

// Reads the index of film_moments.nc. Moments that cannot be read are taken from elsewhere, or count as not
// kept.
void ReachableMoments::read_film_moments() {
    const fs::path file = run_.frames().path() / kFilmMoments;
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) return;
    try {
        film_moments_ = open_frames(file, {.format = "trajectory"});
    } catch (const UserError& problem) {
        news_.push_back(fmt::format("{}; it is not used", problem.what()));
        return;
    }
    for (std::size_t k = 0; k < film_moments_->moments().size(); ++k)
        filmed_.emplace(film_moments_->moments()[k].step, k);
    if (const std::vector<std::string> damage = film_moments_->damage(); !damage.empty())
        news_.push_back(fmt::format("{}; it is not used", damage.front()));
}

void ReachableMoments::check_film_moments() const {
    const std::string name = (run_.frames().path() / kFilmMoments).string();
    check_species(run_.scene(), film_moments_->world(), name);
    for (const auto& [step, place] : filmed_) {
        Frame moment = film_moments_->moments()[place];
        add_planes(run_.scene().walls, moment.time, moment.bodies);
        check_drive(run_.scene(), run_.clock(), moment,
                    fmt::format("{}: frame {}", name, film_moments_->place(place)));
    }
    for (const auto& [step, place] : filmed_) {
        const std::optional<std::size_t> both = in_trajectory(step);
        if (!both) continue;
        try {
            if (same_grains(film_moments_->grains(place), run_.frames().grains(*both))) return;
        } catch (const DamagedFrame&) {
            continue;  // the reader of this frame reports the damage
        }
        throw UserError(
            fmt::format("{}: has other grains at step {} than the trajectory.nc beside it; they are of two "
                        "runs",
                        name, step));
    }
}

std::optional<std::size_t> ReachableMoments::in_trajectory(std::int64_t step) const {
    const std::vector<Frame>& moments = run_.moments();
    const auto found =
        std::lower_bound(moments.begin(), moments.end(), step,
                         [](const Frame& moment, std::int64_t wanted) { return moment.step < wanted; });
    if (found == moments.end() || found->step != step) return std::nullopt;
    return static_cast<std::size_t>(found - moments.begin());
}

ReachableMoments::Place ReachableMoments::place_of(std::int64_t step, bool touches) const {
    if (in_trajectory(step) && (!touches || run_.frames().supply().contacts)) return Place::trajectory;
    if (filmed_.count(step) > 0 && !touches) return Place::film_moments;
    if (replayer_ && replayer_->reaches(step)) return Place::checkpoints;
    return Place::nowhere;
}

Frame ReachableMoments::film_moment(std::size_t index) const {
    Frame frame = film_moments_->grains(index);
    add_planes(run_.scene().walls, frame.time, frame.bodies);
    return frame;
}

ReachableMoments::Found ReachableMoments::at(std::int64_t step, bool touches, const ReplayWatcher& watcher) {
    std::optional<DamagedFrame> damage;
    const auto whole = [&](const auto& read) -> std::optional<Frame> {
        try {
            return read();
        } catch (const DamagedFrame& problem) {
            if (!damage) damage = problem;
            return std::nullopt;
        }
    };
    std::optional<Frame> kept;
    const std::optional<std::size_t> index = in_trajectory(step);
    if (index && (!touches || run_.frames().supply().contacts))
        kept = whole([&] { return run_.frames().grains(*index); });
    const auto filmed = filmed_.find(step);
    if (!kept && filmed != filmed_.end() && !touches)
        kept = whole([&] { return film_moment(filmed->second); });
    if (kept) return {std::move(*kept), false};
    if (replayer_ && replayer_->reaches(step)) {
        prove(step, watcher);
        const Simulation& run = replayer_->at(step, watcher);
        Found found{run.frame(), true};
        if (touches) found.touches = touches_of(run);
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

std::int64_t ReachableMoments::nearest_kept(std::int64_t step, bool touches) const {
    std::int64_t nearest = run_.moments()[run_.frames().nearest(run_.clock().time(step))].step;
    if (touches) return nearest;
    const auto try_one = [&](std::int64_t one) {
        if (std::abs(one - step) < std::abs(nearest - step)) nearest = one;
    };
    const auto after = filmed_.lower_bound(step);
    if (after != filmed_.end()) try_one(after->first);
    if (after != filmed_.begin()) try_one(std::prev(after)->first);
    return nearest;
}

}  // namespace grainreel
