#include "render/film/run/peer_job.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/team.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/handover/deck_dump.hpp"
#include "engine/handover/decks/decks.hpp"
#include "engine/handover/start_state.hpp"
#include "engine/handover/triangle_walls.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/film/sources/stored_shots.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

std::vector<std::int64_t> ordered(std::vector<std::int64_t> steps) {
    std::sort(steps.begin(), steps.end());
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
    return steps;
}

// The scene with the laws that the other engine uses.
FilmedScene as_carried(FilmedScene scene, const CarriedScene& carried) {
    static_cast<Scene&>(scene) = carried.scene;
    return scene;
}

// Step of the newest restart file. Throws UserError if there is none, or if the run has come to its end.
std::int64_t restart_to_go_on(const fs::path& run) {
    const fs::path place = run / ReturnedRun::kFolder;
    const HandoverFacts facts = read_handover(place);
    const std::optional<std::int64_t> step = newest_restart(place, facts.engine);
    if (!step)
        throw UserError(
            "{}: {} has left no restart file, so that nothing is there to go on from; run its "
            "scene.toml again",
            run.string(), name_of(facts.engine));
    if (is_there(place / end_name) || *step >= facts.last + facts.shift)
        throw UserError(
            "{}: {} has come to its end already, and a longer run is another deck; "
            "run the scene again with a longer run.duration",
            run.string(), name_of(facts.engine));
    return *step;
}

// Reads what is known of a run that was handed over before.
CarriedScene as_handed_over(const fs::path& run, const FilmedScene& scene, const Plan& plan) {
    const HandoverFacts facts = read_handover(run / ReturnedRun::kFolder);
    CarriedScene carried;
    carried.engine = facts.engine;
    carried.ranks = facts.ranks;
    carried.scene = scene;
    carried.plan = plan;
    carried.frame = facts.frame;
    carried.step = facts.step;
    carried.first = facts.first;
    carried.last = facts.last;
    for (const std::string& change : facts.changes) carried.changes.push_back({{}, change, {}});
    return carried;
}

}  // namespace

std::vector<std::int64_t> needed_steps(const FilmedScene& scene, const Clock& clock, std::int64_t steps) {
    std::vector<std::int64_t> needed;
    const std::vector<FilmSegment> segments = segments_of(scene.film);
    for (const Due& shot : film_schedule(scene, clock, steps)) {
        needed.push_back(shot.step);
        const FilmSegment& segment = segments[shot.segment];
        for (const auto& more : {exposed_steps(shot, segment, clock), averaged_steps(shot, segment, clock)})
            needed.insert(needed.end(), more.begin(), more.end());
    }
    std::sort(needed.begin(), needed.end());
    needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
    std::erase_if(needed, [](std::int64_t step) { return step < 0; });
    return needed;
}

void want_pictures(CarriedScene& carried, const FilmedScene& scene) {
    constexpr std::size_t most_paces = 200;
    std::vector<std::int64_t> pictures = needed_steps(scene, carried.plan.clock, carried.plan.steps);
    if (pictures.empty()) return;
    pictures.push_back(carried.first);
    pictures.push_back(carried.last);
    std::vector<std::int64_t> both = carried.dumps;
    both.insert(both.end(), pictures.begin(), pictures.end());
    pictures = ordered(std::move(pictures));
    both = ordered(std::move(both));
    carried.dumps = dump_paces(both).size() <= most_paces + dump_paces(pictures).size() ? both : pictures;
}

PeerJob::PeerJob(const FilmRequest& request, Listener& listener, const FilmedScene& scene,
                 CarriedScene carried)
    : FilmJob(request, listener),
      carried_(std::move(carried)),
      scene_(as_carried(scene, carried_)),
      job_(carried_.engine, carried_.ranks, deck_name(carried_.engine)) {
    film_.check(scene_, pictures());
    film_.use_threads(drawing_threads(scene_.run.threads));
    make_folder({scene_.name, request_.base, request_.out, request_.force});
}

PeerJob::PeerJob(const FilmRequest& request, Listener& listener, const FilmedScene& scene, const Plan& plan,
                 std::shared_ptr<FolderLock> lock)
    : FilmJob(request, listener),
      restart_(restart_to_go_on(lock->folder())),
      carried_(as_handed_over(lock->folder(), scene, plan)),
      scene_(scene),
      job_(carried_.engine, carried_.ranks, deck_name(carried_.engine),
           fmt::format("{}.{}", restart_name(carried_.engine), *restart_)) {
    film_.check(scene_, pictures());
    film_.use_threads(drawing_threads(scene_.run.threads));
    make_folder({.name = scene_.name, .out = request_.out, .goes_on = std::move(lock)});
    mark_begun();
}

std::int64_t PeerJob::pictures() const {
    return std::ssize(film_schedule(scene_, carried_.plan.clock, carried_.plan.steps));
}

std::vector<std::string> PeerJob::warnings() const {
    std::vector<std::string> all = carried_.plan.warnings;
    for (const CarryNote& change : carried_.changes)
        all.push_back(fmt::format("{}{}{}{}", change.where.empty() ? "" : change.where + ": ", change.what,
                                  change.why.empty() ? "" : "; ", change.why));
    all.insert(all.end(), job_.notes().begin(), job_.notes().end());
    for (const std::string& one : film_warnings(scene_, pictures()))
        if (film_.wanted()) all.push_back(one);
    return all;
}

bool PeerJob::work() {
    RunJson& record = desk_.record;
    record.scene_file = scene_.file;
    record.seed = scene_.run.seed;
    record.grains = scene_.grains();
    record.step = carried_.step;
    record.steps_planned = carried_.last;
    record.engine_threads = carried_.ranks;
    record.libraries.emplace_back(name_of(carried_.engine), job_.program().version);
    begin_record(warnings());
    if (restart_) {
        take_up();
    } else {
        keep_mesh_files(scene_, folder(), desk_.folder->previous());
        replace_file(folder() / "scene.toml", resolved_scene(scene_, carried_.plan));
        if (!hand_over()) return false;
        mark_begun();
    }
    follow();
    const bool stopped = desk_.listener.stop_signal() != 0;
    const std::string failure = !unsound_.empty() ? unsound_ : stopped ? "" : job_.failure();
    if (!failure.empty() && back_->frames() > 0)
        desk_.listener.info(fmt::format("{}; the film shows what there is", failure));
    if (back_->frames() > 0) {
        back_->close(record);
        if (const std::string overlap = back_->overlap_text(); !overlap.empty()) {
            desk_.listener.warning(overlap);
            record.warnings.push_back(overlap);
        }
        draw();
    }
    if (!failure.empty()) throw RunError(failure);
    if (stopped) return false;
    if (record.steps < carried_.last)
        throw RunError("{} ended at {:.6g} of {:.6g} s without an error; its output is in {}",
                       name_of(carried_.engine), record.simulated, carried_.plan.clock.time(carried_.last),
                       (folder() / ReturnedRun::kFolder / PeerProcess::kOutput).string());
    return true;
}

// Packs the grains and writes all that the engine needs. Returns false when told to stop.
bool PeerJob::hand_over() {
    const auto timer = desk_.times.during("packing");
    const auto watcher = [&](const PackingProgress& now) {
        Progress progress;
        progress.stage = Progress::Stage::settling;
        if (now.stage == PackingProgress::Stage::growing) progress.stage = Progress::Stage::growing;
        if (now.stage == PackingProgress::Stage::raining) progress.stage = Progress::Stage::raining;
        progress.done = now.done;
        progress.elapsed = desk_.watch.seconds();
        desk_.listener.progress(progress);
        desk_.folder->lock().check_there();
        return desk_.listener.stop_signal() == 0;
    };
    const int processors = scene_.run.threads > 0 ? scene_.run.threads : usable_processors();
    const int threads = plan_threads(processors, false, scene_.grains()).engine;
    const StartState start = start_state(carried_, threads, watcher);
    if (start.stopped) return false;
    if (carried_.engine == PeerEngine::liggghts) make_room_for_walls(carried_);
    fs::create_directories(place());
    write_handover(place(), carried_, start, desk_.record.version);
    back_ = std::make_unique<ReturnedRun>(folder(), scene_, carried_.plan, read_handover(place()),
                                          desk_.record.version);
    return true;
}

// Prepares to go on from the restart file. Later steps are cut off from the dump, since the engine will write
// them again.
void PeerJob::take_up() {
    const HandoverFacts facts = read_handover(place());
    trim_dump(facts.dump, *restart_);
    // The output of the engine's earlier start is moved away, so that an error in it is not taken for a new
    // one.
    std::error_code ignored;
    fs::rename(place() / PeerProcess::kOutput, place() / "engine.before.txt", ignored);
    back_ = std::make_unique<ReturnedRun>(folder(), scene_, carried_.plan, facts, desk_.record.version);
}

// Follows the engine until it has ended and all that it wrote is read. An engine whose run lost grains or got
// unsound is stopped.
void PeerJob::follow() {
    const auto timer = desk_.times.during("engine");
    desk_.listener.detail(job_.command());
    running_ = Stopwatch();
    job_.start(place());
    bool told = false;
    while (job_.is_running()) {
        const bool ends = desk_.listener.stop_signal() != 0 || !unsound_.empty();
        if (ends && !std::exchange(told, true)) job_.stop();
        desk_.folder->lock().check_there();
        if (!read_dump()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
        show_progress();
    }
    while (read_dump()) continue;
    take_forced_restarts(place(), place() / PeerProcess::kOutput);
}

bool PeerJob::read_dump() {
    if (!unsound_.empty()) return false;
    try {
        return back_->take_next();
    } catch (const RunError& wrong) {
        unsound_ = wrong.what();
    } catch (const UserError& wrong) {
        unsound_ = wrong.what();
    }
    return false;
}

void PeerJob::show_progress() {
    Progress progress;
    progress.stage = Progress::Stage::vibrating;
    progress.end = carried_.plan.clock.time(carried_.last);
    progress.elapsed = desk_.watch.seconds();
    if (const State* const last = back_->last()) {
        progress.time = last->time;
        progress.done =
            static_cast<double>(last->step) / static_cast<double>(std::max<std::int64_t>(1, carried_.last));
        const double seconds = running_.seconds();
        progress.particle_steps_per_second =
            static_cast<double>(last->step) * static_cast<double>(last->size()) / seconds;
        if (progress.done > 0 && seconds > 1)
            progress.remaining = seconds * (1 - progress.done) / progress.done;
        desk_.record.particle_steps_per_second = progress.particle_steps_per_second;
    }
    desk_.listener.progress(progress);
}

// Draws the film from the run's own files, as `render` does.
bool PeerJob::draw() {
    if (!film_.wanted()) return true;
    constexpr bool replay = false;
    StoredShots source(folder(), {}, replay);
    const std::vector<Due> shots = source.shown_shots();
    if (shots.empty()) return true;
    const auto go_on = [this] { return !desk_.listener.in_a_hurry(); };
    const StatePtr start = source.grains(shots.front().step, go_on);
    if (!start) return false;
    film_.open(source.scene(), std::ssize(shots), start);
    source.start(shots, source.segments());
    while (std::optional<Taken> picture = source.next(go_on)) {
        film_.show(*picture, source.segments().at(static_cast<std::size_t>(picture->segment)),
                   source.clock());
        film_.show_progress();
    }
    return true;
}

void PeerJob::conclude() {
    if (back_ && desk_.record.trajectory_frames == 0) desk_.record.trajectory_frames = back_->frames();
}

void PeerJob::side_work_closed() {
    film_.write_times();
}

std::string PeerJob::stopped_text() const {
    return fmt::format("stopped at {:.2f} of {:.2f} s", desk_.record.simulated,
                       carried_.plan.clock.time(carried_.last));
}

void PeerJob::report_written() {
    desk_.listener.info(fmt::format(
        "wrote {}: {}trajectory.nc ({}), measures.csv, final.csv, {}/ (deck, dump and output of {}), "
        "run.json, log.txt{}",
        folder().string(), film_.files_text(), counted(desk_.record.trajectory_frames, "frame"),
        ReturnedRun::kFolder, name_of(carried_.engine), page_text()));
    desk_.listener.info(
        fmt::format("took {}: packing {}, {} {} on {} {} ({:.1f} M particle-steps/s)",
                    duration_text(desk_.watch.seconds()), duration_text(desk_.times.of("packing")),
                    name_of(carried_.engine), job_.program().version, counted(carried_.ranks, "rank"),
                    duration_text(desk_.times.of("engine")), desk_.record.particle_steps_per_second * 1e-6));
}

}  // namespace grainreel
