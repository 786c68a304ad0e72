#include "engine/questions/asked_moment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/run_names.hpp"
#include "engine/questions/snapshot.hpp"
#include "engine/run/driver/run_files.hpp"
#include "engine/run/replay/checkpoint_ring.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

// Acceleration (m/s2) of each grain of `now`, from its places now and a step later: x' = x + dt v + dt^2 a
// / 2 with velocity Verlet, x' = x + dt (v + dt a) with leapfrog. Empty with other integrators.
std::vector<Vec3> accelerations(const Scene& scene, const Frame& now, const Frame& later, double step) {
    const Integrator integrator = scene.run.integrator;
    if (integrator != Integrator::velocity_verlet && integrator != Integrator::leapfrog) return {};
    const double share = integrator == Integrator::velocity_verlet ? 2 : 1;
    const double depth = scene.container.periodic_depth ? scene.container.depth : 0;
    std::vector<Vec3> all;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const std::optional<std::size_t> there = later.row_of(now.id[i]);
        if (!there) {  // the grain leaves in this step
            all.push_back(Vec3::Constant(std::nan("")));
            continue;
        }
        Vec3 way = later.position[*there] - now.position[i];
        way.x() = nearest_image(way.x(), depth);
        all.push_back(share * (way - step * now.velocity[i]) / (step * step));
    }
    return all;
}

}  // namespace

// The last time that can be asked for. A run that was broken off has checkpoints after its last kept
// moment.
double MomentFinder::last_time() const {
    const std::vector<KeptCheckpoint> kept = run_.checkpoints();
    const double last = run_.to();
    return kept.empty() ? last : std::max(last, run_.clock().time(kept.back().step));
}

AskedMoment MomentFinder::find(const MomentRequest& request) const {
    const Clock& clock = run_.clock();
    const std::vector<Frame>& moments = run_.moments();
    const auto named = [&](double time, const char* option) {
        const double from = run_.from(), to = last_time(), hair = 1e-9 + 1e-9 * std::abs(time);
        if (std::isnan(from) || std::isnan(to))
            throw UserError(fmt::format("{}: the time of {} is not known; leave it out", option,
                                        run_.frames().path().string()));
        // A run of 8 s ends with its last whole step, which may lie a little before.
        if (time > to && time <= to + clock.step * (1 + 1e-9)) time = to;
        if (!(time >= from - hair && time <= to + hair))
            throw UserError(fmt::format("{}: {:.6g} s is outside the run, which goes from {:.6g} to {:.6g} s",
                                        option, time, from, to));
        AskedMoment asked;
        asked.nearest = run_.frames().nearest(time);
        asked.step = clock.step > 0 ? std::llround(time / clock.step) : moments[asked.nearest].step;
        if (moments[asked.nearest].step == asked.step) asked.kept = asked.nearest;
        asked.time = clock.step > 0 ? clock.time(asked.step) : moments[asked.nearest].time;
        return asked;
    };
    if (request.at) return named(*request.at, request.at_option);
    if (request.frame && run_.frames().scene() == nullptr)
        return kept_frame(*request.frame, run_.frames().path().string());
    if (request.frame && request.frame_of_file) return kept_frame(*request.frame, run_.scene().title);
    if (request.frame) return named(clock.time(step_of_frame(request)), "--frame");
    if (request.cycle) {
        if (!run_.scene().drive.present) throw UserError("--cycle: the run has no drive; give --at TIME");
        return named(clock.time(clock.step_at(*request.cycle)), "--cycle");
    }
    return last();
}

// Finds a kept moment by its frame number. An imported file of frames has no film, so its own frames are
// counted.
AskedMoment MomentFinder::kept_frame(std::int64_t frame, const std::string& name) const {
    const std::vector<Frame>& moments = run_.moments();
    const auto count = static_cast<std::int64_t>(moments.size());
    if (frame < 0 || frame >= count)
        throw UserError(
            fmt::format("--frame: {} has the frames 0 to {}, but {} is asked for", name, count - 1, frame));
    const auto index = static_cast<std::size_t>(frame);
    return {moments[index].step, moments[index].time, index, index, frame + 1 == count};
}

// The end of a run is in its last checkpoint; it need not be among the kept moments.
AskedMoment MomentFinder::last() const {
    const std::vector<Frame>& moments = run_.moments();
    const std::vector<KeptCheckpoint> kept = run_.checkpoints();
    const std::size_t back = moments.size() - 1;
    if (!kept.empty() && kept.back().step > moments[back].step)
        return {kept.back().step, run_.clock().time(kept.back().step), std::nullopt, back, true};
    return {moments[back].step, moments[back].time, back, back, true};
}

// The step that a frame of the run's film shows. The run kept one moment for each picture. A picture that is
// held for a caption counts once for each frame in which the film shows it.
std::int64_t MomentFinder::step_of_frame(const MomentRequest& request) const {
    const std::filesystem::path file = run_.frames().path() / kFilmMoments;
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        throw UserError(
            fmt::format("--frame: {} has no {}, so that the moments of its film are not known; give --at "
                        "TIME, or run the scene again with its film and output.film_moments = true",
                        run_.frames().path().string(), kFilmMoments));
    const std::int64_t frame = *request.frame;
    const auto pictures = open_frames(file, {.format = "trajectory"});
    const std::vector<std::string> damage = pictures->damage();
    std::int64_t shown = 0;
    for (std::size_t k = 0; k < pictures->moments().size(); ++k) {
        if (pictures->place(k) != k) break;  // from the first damaged picture on the numbers are unknown
        const Frame& moment = pictures->moments()[k];
        shown += 1 + (request.held ? request.held(moment.time) : 0);
        if (frame < shown && frame >= 0) return moment.step;
    }
    if (!damage.empty()) throw UserError(damage.front());
    throw UserError(
        fmt::format("--frame: the film has the frames 0 to {}, but {} is asked for", shown - 1, frame));
}

Snapshot MomentFinder::kept(std::size_t index) const {
    Snapshot snapshot{run_.scene(), run_.frame(index), run_.frames().has_contacts_of(index),
                      run_.frames().first()};
    run_.add_kept(index, snapshot);
    snapshot.measured = run_.measured_near(index);
    const FrameSupply supply = run_.frames().supply();
    snapshot.spins = supply.spins;
    snapshot.velocities = supply.velocities;
    if (!supply.velocities)
        std::fill(snapshot.frame.velocity.begin(), snapshot.frame.velocity.end(),
                  Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    return snapshot;
}

bool MomentFinder::is_checkpoint(const AskedMoment& moment) const {
    const std::vector<KeptCheckpoint> kept = run_.checkpoints();
    return std::any_of(kept.begin(), kept.end(), [&](const auto& one) { return one.step == moment.step; });
}

bool MomentFinder::can_bring_back(const AskedMoment& moment) const {
    const std::vector<KeptCheckpoint> kept = run_.checkpoints();
    return !kept.empty() && kept.front().step <= moment.step;
}

namespace {

// The snapshot of a restored run, without accelerations.
Snapshot snapshot_of(const Simulation& run, const AskedRun& asked) {
    Snapshot snapshot{asked.scene(), run.frame(), true, asked.frames().first()};
    for (const SavedContact& one : run.contacts())
        snapshot.touches.push_back({one.first, one.second, one.normal});
    snapshot.measured = MeasuredRow{snapshot.frame.time, run.measured(), run.measures().values()};
    snapshot.forces.emplace();
    snapshot.forces->contacts = run.contact_forces();
    return snapshot;
}

}  // namespace

void MomentFinder::check_can_bring_back(const AskedMoment& moment) const {
    if (can_bring_back(moment)) return;
    const bool none = run_.checkpoints().empty();
    if (none && is_of_another_engine(run_.frames().path()))
        throw UserError(
            fmt::format("{}: another engine computed the run, so that no moment can be brought back; "
                        "ask for a kept moment with --no-replay",
                        run_.frames().path().string()));
    throw UserError(fmt::format(
        "{}: has no checkpoint{}, so that {} brought back; ask for a kept moment with --no-replay, or "
        "run the scene again with output.checkpoints",
        run_.frames().path().string(), none ? "s" : fmt::format(" of {:.6g} s or before", moment.time),
        none ? "no moment can be" : "this moment cannot be"));
}

Snapshot MomentFinder::brought_back(const AskedMoment& moment, const ReplayWatcher& watcher) {
    check_can_bring_back(moment);
    const Scene& scene = run_.scene();
    Simulation run =
        replayed(run_.frames().path(), run_.checkpoints(), moment.step, scene.run.threads, watcher);
    Snapshot snapshot = snapshot_of(run, run_);
    run.advance(moment.step + 1);
    snapshot.forces->acceleration = accelerations(scene, snapshot.frame, run.frame(), run_.clock().step);
    return snapshot;
}

Snapshot MomentFinder::brought_back_with_ways(const AskedMoment& moment, const ReplayWatcher& watcher) {
    const Scene& scene = run_.scene();
    if (!scene.drive.present)
        throw UserError("the run has no drive, so that there are no ways over a period of it");
    const Clock& clock = run_.clock();
    const int periods = run_.frames().periods();
    const AskedMoment before{clock.step_at(clock.cycles(moment.step) - periods),
                             clock.time(moment.step) - periods / scene.drive.highest_frequency(),
                             {},
                             0};
    if (before.step < run_.moments().front().step || !can_bring_back(before))
        throw UserError(fmt::format(
            "ways over a period need the moment {} before {:.6g} s, and the run does not reach back so far",
            periods == 1 ? "one period" : fmt::format("{} periods", periods), moment.time));
    const Frame then =
        replayed(run_.frames().path(), run_.checkpoints(), before.step, scene.run.threads, watcher).frame();
    Snapshot snapshot = brought_back(moment, watcher);
    snapshot.displacement =
        displacement_since(then, snapshot.frame, periods, period_of_depth(scene.container));
    return snapshot;
}

void MomentFinder::over_periods(const AskedMoment& moment, double periods, bool replay,
                                const ReplayWatcher& watcher, const std::function<void(Snapshot)>& see) {
    const Clock& clock = run_.clock();
    if (!run_.scene().drive.present) throw UserError("--average: the run has no drive, and so no periods");
    const double end = clock.cycles(moment.step);
    const std::int64_t from = clock.step_at(end - periods);
    if (clock.time(from) < run_.from() - 1e-9)
        throw UserError(
            fmt::format("--average: {} periods before {:.6g} s lie before the run's first moment, {:.6g} s; "
                        "ask for fewer",
                        periods, moment.time, run_.from()));
    if (!replay) {
        for (std::size_t k = 0; k < run_.moments().size(); ++k)
            if (const std::int64_t step = run_.moments()[k].step; step > from && step <= moment.step)
                see(kept(k));
        return;
    }
    const auto count = static_cast<std::int64_t>(std::ceil(periods * kMomentsAPeriod));
    const auto step_of = [&](std::int64_t k) {
        return clock.step_at(end - static_cast<double>(count - 1 - k) / kMomentsAPeriod);
    };
    Simulation run =
        replayed(run_.frames().path(), run_.checkpoints(), step_of(0), run_.scene().run.threads, watcher);
    for (std::int64_t k = 0; k < count; ++k) {
        run.advance(step_of(k));
        see(snapshot_of(run, run_));
        if (!watcher(static_cast<double>(k + 1) / static_cast<double>(count)))
            throw RunError("stopped before the moments were reached");
    }
}

void MomentFinder::at_every(double interval, const ReplayWatcher& watcher,
                            const std::function<void(const Snapshot&)>& see) {
    constexpr double most = 1e6, rounding = 1e-9;
    const Clock& clock = run_.clock();
    const std::int64_t last_step = run_.moments().back().step;
    const double first = std::ceil(run_.from() / interval - rounding),
                 count = std::floor(run_.to() / interval + rounding) - first + 1;
    if (interval < clock.step)
        throw UserError(fmt::format(
            "--every: is shorter than a step of the run, {:.4g} s; take a longer time", clock.step));
    if (count > most)
        throw UserError(fmt::format(
            "--every: makes {:.3g} moments, and the most are {:.0g}; take a longer time", count, most));
    if (count < 1) throw UserError("--every: no multiple of it lies in the run; take a shorter time");
    const auto step_of = [&](double k) {
        return std::min(last_step,
                        static_cast<std::int64_t>(std::llround((first + k) * interval / clock.step)));
    };
    AskedMoment begin;
    begin.step = step_of(0);
    begin.time = clock.time(begin.step);
    check_can_bring_back(begin);
    Simulation run =
        replayed(run_.frames().path(), run_.checkpoints(), begin.step, run_.scene().run.threads, watcher);
    for (double k = 0; k < count; ++k) {
        run.advance(step_of(k));
        see(snapshot_of(run, run_));
        if (!watcher((k + 1) / count)) throw RunError("stopped before the moments were reached");
    }
}

}  // namespace grainreel
