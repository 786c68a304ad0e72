#include "engine/questions/asked_moment.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/run_names.hpp"
#include "engine/questions/snapshot.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

// Acceleration (m/s2) of each grain of `now`, from its places now and a step later: x' = x + dt v + dt^2 a
// / 2 with velocity Verlet, x' = x + dt (v + dt a) with leapfrog. Empty with other integrators.
std::vector<Vec3> accelerations(const Scene& scene, const State& now, const State& later, double step) {
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

// The number of a frame from 0; one below 0 counts from the end, so that -1 is the last.
std::int64_t from_start(std::int64_t frame, std::int64_t count) {
    return frame < 0 ? frame + count : frame;
}

// Finds a kept moment by its frame number. An imported file of frames has no film, so its own frames are
// counted.
AskedMoment kept_frame(const StoredRun& run, std::int64_t asked, const std::string& name) {
    const std::vector<State>& moments = run.moments();
    const auto count = static_cast<std::int64_t>(moments.size());
    const std::int64_t frame = from_start(asked, count);
    if (frame < 0 || frame >= count)
        throw UserError("--frame: {} has the frames 0 to {}, but {} is asked for", name, count - 1, asked);
    const auto index = static_cast<std::size_t>(frame);
    return {moments[index].step, moments[index].time, index, index, frame + 1 == count};
}

// The end of a run is in its last checkpoint; it need not be among the kept moments.
AskedMoment last_moment(const StoredRun& run) {
    const std::vector<State>& moments = run.moments();
    const std::vector<KeptCheckpoint>& kept = run.checkpoints();
    const std::size_t back = moments.size() - 1;
    if (!kept.empty() && kept.back().step > moments[back].step)
        return {kept.back().step, run.clock().time(kept.back().step), std::nullopt, back, true};
    return {moments[back].step, moments[back].time, back, back, true};
}

// The step that a frame of the run's film shows. The run kept one moment for each picture. A picture that is
// held for a caption counts once for each frame in which the film shows it.
std::int64_t step_of_frame(const StoredRun& run, const MomentRequest& request) {
    const std::filesystem::path file = run.path() / kFilmMoments;
    if (!is_there(file))
        throw UserError(
            "--frame: {} has no {}, so that the moments of its film are not known; give --at "
            "TIME, or run the scene again with its film and output.film_moments = true",
            run.path().string(), kFilmMoments);
    const StateArchive* const pictures = run.kept().film();
    if (pictures == nullptr) throw UserError(run.kept().faults_of_film().front().what);
    const std::vector<std::string> damage = pictures->damage();
    std::vector<std::pair<std::int64_t, std::int64_t>> ends;  // frames up to each picture, and its step
    std::int64_t shown = 0;
    for (std::size_t k = 0; k < pictures->moments().size(); ++k) {
        if (pictures->place(k) != k) break;  // from the first damaged picture on the numbers are unknown
        const State& moment = pictures->moments()[k];
        shown += 1 + (request.held ? request.held(moment.time) : 0);
        ends.emplace_back(shown, moment.step);
    }
    const std::int64_t frame = damage.empty() ? from_start(*request.frame, shown) : *request.frame;
    for (const auto& [end, step] : ends)
        if (frame >= 0 && frame < end) return step;
    if (!damage.empty()) throw UserError(damage.front());
    throw UserError("--frame: the film has the frames 0 to {}, but {} is asked for", shown - 1,
                    *request.frame);
}

// The snapshot of a restored run, without accelerations.
Snapshot snapshot_of(const SimulatedBed& simulation, const StoredRun& run) {
    Snapshot snapshot{run.known_scene(), simulation.frame(), true, run.first()};
    snapshot.touches = touches_of(simulation);
    snapshot.measured =
        MeasuredRow{snapshot.frame.time, simulation.measured(), simulation.measures().values()};
    snapshot.forces.emplace();
    snapshot.forces->contacts = simulation.contact_forces();
    return snapshot;
}

// Adds the displacements over the last period, where the run kept the moment a period earlier.
void add_kept_ways(const StoredRun& run, Snapshot& snapshot) {
    const Clock& clock = run.clock();
    if (!run.known_scene().drive.present || clock.step <= 0) return;
    const std::int64_t before = clock.step_at(clock.cycles(snapshot.frame.step) - run.periods());
    const std::optional<std::size_t> index = run.index_near(clock.time(before));
    if (before >= run.moments().front().step && index)
        snapshot.displacement = displacement_since(run.grains(*index), snapshot.frame, run.periods(),
                                                   period_of_depth(run.known_scene().container));
}

void check_can_bring_back(const StoredRun& run, const AskedMoment& moment) {
    if (run.brings_back(moment.step)) return;
    const bool none = run.checkpoints().empty();
    if (none && run.kind() == StoredRun::Kind::elsewhere)
        throw UserError(
            "{}: another engine computed the run, so that no moment can be brought back; "
            "ask for a kept moment with --no-replay",
            run.path().string());
    throw UserError(
        "{}: has no checkpoint{}, so that {} brought back; ask for a kept moment with --no-replay, or "
        "run the scene again with output.checkpoints",
        run.path().string(), none ? "s" : fmt::format(" of {:.6g} s or before", moment.time),
        none ? "no moment can be" : "this moment cannot be");
}

}  // namespace

AskedMoment find_moment(const StoredRun& run, const MomentRequest& request) {
    const Clock& clock = run.clock();
    const std::vector<State>& moments = run.moments();
    const auto named = [&](double time, const char* option) {
        const double from = run.from(),
                     to = std::max(run.to(), clock.step > 0 ? clock.time(run.last_step()) : run.to());
        // A run of 8 s ends with its last whole step, which may lie a little before, and messages show times
        // with six digits.
        const double room = std::max(clock.step, 1e-5 * std::abs(time)) * (1 + 1e-9) + 1e-9;
        if (time >= from - room && time <= to + room) time = std::clamp(time, from, std::max(from, to));
        run.check_time(option, time, to, 0);
        AskedMoment asked;
        asked.nearest = run.nearest(time);
        asked.step = clock.step > 0 ? std::llround(time / clock.step) : moments[asked.nearest].step;
        // What cannot be brought back is asked for as it was kept.
        const bool kept_alone =
            run.kind() != StoredRun::Kind::ours && run.kind() != StoredRun::Kind::elsewhere;
        if (kept_alone && std::abs(moments[asked.nearest].time - time) <= run.room_beside(asked.nearest))
            asked.step = moments[asked.nearest].step;
        if (moments[asked.nearest].step == asked.step) asked.kept = asked.nearest;
        asked.time = clock.step > 0 ? clock.time(asked.step) : moments[asked.nearest].time;
        return asked;
    };
    if (request.at) return named(*request.at, request.at_option);
    if (request.frame && run.scene() == nullptr) return kept_frame(run, *request.frame, run.path().string());
    if (request.frame && request.frame_of_file)
        return kept_frame(run, *request.frame, run.known_scene().title);
    if (request.frame) return named(clock.time(step_of_frame(run, request)), "--frame");
    if (request.cycle) {
        if (!run.known_scene().drive.present)
            throw UserError("--cycle: the run has no drive; give --at TIME");
        return named(clock.time(clock.step_at(*request.cycle)), "--cycle");
    }
    return last_moment(run);
}

bool has_checkpoint(const StoredRun& run, const AskedMoment& moment) {
    const std::vector<KeptCheckpoint>& kept = run.checkpoints();
    return std::any_of(kept.begin(), kept.end(), [&](const auto& one) { return one.step == moment.step; });
}

Snapshot kept_snapshot(const StoredRun& run, std::size_t index, bool with_ways) {
    Snapshot snapshot{run.known_scene(), run.grains(index), run.has_contacts_of(index), run.first()};
    if (std::optional<std::vector<Link>> touches = run.touches(index)) snapshot.touches = std::move(*touches);
    if (with_ways) add_kept_ways(run, snapshot);
    snapshot.measured = run.measured_near(index);
    const StateSupply supply = run.supply();
    snapshot.spins = supply.spins;
    snapshot.velocities = supply.velocities;
    if (!supply.velocities)
        std::fill(snapshot.frame.velocity.begin(), snapshot.frame.velocity.end(), Vec3::Constant(kUnknown));
    return snapshot;
}

Snapshot brought_back_snapshot(StoredRun& run, const AskedMoment& moment, const ReplayWatcher& watcher) {
    check_can_bring_back(run, moment);
    SimulatedBed& simulation = run.brought_back(moment.step, watcher);
    Snapshot snapshot = snapshot_of(simulation, run);
    simulation.advance(moment.step + 1);
    snapshot.forces->acceleration =
        accelerations(run.known_scene(), snapshot.frame, simulation.frame(), run.clock().step);
    return snapshot;
}

Snapshot brought_back_with_ways(StoredRun& run, const AskedMoment& moment, const ReplayWatcher& watcher) {
    const Scene& scene = run.known_scene();
    if (!scene.drive.present)
        throw UserError("the run has no drive, so that there are no ways over a period of it");
    const Clock& clock = run.clock();
    const int periods = run.periods();
    const AskedMoment before{clock.step_at(clock.cycles(moment.step) - periods),
                             clock.time(moment.step) - periods / scene.drive.highest_frequency(),
                             {},
                             0};
    if (before.step < run.moments().front().step || !run.brings_back(before.step))
        throw UserError(
            "ways over a period need the moment {} before {:.6g} s, and the run does not reach back so far",
            periods == 1 ? "one period" : fmt::format("{} periods", periods), moment.time);
    const State then = run.brought_back(before.step, watcher).frame();
    Snapshot snapshot = brought_back_snapshot(run, moment, watcher);
    snapshot.displacement =
        displacement_since(then, snapshot.frame, periods, period_of_depth(scene.container));
    return snapshot;
}

void see_periods(StoredRun& run, const AskedMoment& moment, double periods, bool replay,
                 const ReplayWatcher& watcher, const std::function<void(Snapshot)>& see) {
    const Clock& clock = run.clock();
    if (!run.known_scene().drive.present)
        throw UserError("--average: the run has no drive, and so no periods");
    const double end = clock.cycles(moment.step);
    const std::int64_t from = clock.step_at(end - periods);
    if (clock.time(from) < run.from() - 1e-9)
        throw UserError(
            "--average: {} periods before {:.6g} s lie before the run's first moment, {:.6g} s; "
            "ask for fewer",
            periods, moment.time, run.from());
    if (!replay) {
        for (std::size_t k = 0; k < run.moments().size(); ++k)
            if (const std::int64_t step = run.moments()[k].step; step > from && step <= moment.step)
                see(kept_snapshot(run, k));
        return;
    }
    const auto count = static_cast<std::int64_t>(std::ceil(periods * kMomentsAPeriod));
    const auto step_of = [&](std::int64_t k) {
        return clock.step_at(end - static_cast<double>(count - 1 - k) / kMomentsAPeriod);
    };
    SimulatedBed& simulation = run.brought_back(step_of(0), watcher);
    for (std::int64_t k = 0; k < count; ++k) {
        simulation.advance(step_of(k));
        see(snapshot_of(simulation, run));
        if (!watcher(static_cast<double>(k + 1) / static_cast<double>(count)))
            throw RunError("stopped before the moments were reached");
    }
}

double room_in(const StoredRun& run, double interval) {
    // Half a step, because the ends of a run lie at whole steps.
    return std::clamp(0.501 * run.clock().step / interval, 1e-9, 0.25);
}

void see_every(StoredRun& run, double interval, const ReplayWatcher& watcher,
               const std::function<void(const Snapshot&)>& see) {
    constexpr double most = 1e6;
    const Clock& clock = run.clock();
    const double rounding = room_in(run, interval);
    const std::int64_t first_step = run.moments().front().step, last_step = run.moments().back().step;
    const double first = std::ceil(run.from() / interval - rounding),
                 count = std::floor(run.to() / interval + rounding) - first + 1;
    if (interval < clock.step)
        throw UserError("--every: is shorter than a step of the run, {:.4g} s; take a longer time",
                        clock.step);
    if (count > most)
        throw UserError("--every: makes {:.3g} moments, and the most are {:.0g}; take a longer time", count,
                        most);
    if (count < 1) throw UserError("--every: no multiple of it lies in the run; take a shorter time");
    const auto step_of = [&](double k) {
        const auto step = static_cast<std::int64_t>(std::llround((first + k) * interval / clock.step));
        return std::clamp(step, first_step, last_step);
    };
    AskedMoment begin;
    begin.step = step_of(0);
    begin.time = clock.time(begin.step);
    check_can_bring_back(run, begin);
    SimulatedBed& simulation = run.brought_back(begin.step, watcher);
    for (double k = 0; k < count; ++k) {
        simulation.advance(step_of(k));
        see(snapshot_of(simulation, run));
        if (!watcher((k + 1) / count)) throw RunError("stopped before the moments were reached");
    }
}

}  // namespace grainreel
