#include "render/cli/movie_run.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "build_info.hpp"
#include "engine/base/error.hpp"
#include "engine/base/team.hpp"
#include "engine/base/text_file.hpp"
#include "engine/laws/law_kernel.hpp"
#include "engine/scene/writer.hpp"
#include "render/cli/stop_signal.hpp"
#include "render/cli/version.hpp"

namespace grainreel {

namespace {

constexpr double checkpoint_interval = 30;  // s, of wall time

std::vector<Shot> schedule(const Scene& scene, const Plan& plan, bool wanted) {
    return wanted ? film_schedule(scene.film, plan.clock, plan.steps) : std::vector<Shot>();
}

ThreadPlan threads_for(const Scene& scene, bool film) {
    const int processors = scene.run.threads > 0 ? scene.run.threads : usable_processors();
    return plan_threads(processors, film, scene.grains());
}

}  // namespace

MovieRun::MovieRun(const Options& options, Reporter& reporter, const Scene& scene, const Plan& plan)
    : options_(options),
      reporter_(reporter),
      scene_(scene),
      plan_(plan),
      threads_(threads_for(scene, wants_pictures())),
      shots_(schedule(scene, plan, wants_pictures())),
      simulation_(std::in_place, scene, plan, threads_.engine),
      folder_({scene.name, options.base, options.out, options.force}),
      log_(folder_.path() / "log.txt") {
    reporter_.keep_log(&log_);
}

MovieRun::~MovieRun() {
    reporter_.keep_log(nullptr);
}

int MovieRun::run() {
    bool stopped = false;
    try {
        describe();
        stopped = !pack() || !vibrate();
    } catch (const UserError&) {
        if (files_) throw;  // cannot be: all that the user gave has been read by then
        reporter_.keep_log(nullptr);
        folder_.discard();
        throw;
    } catch (const std::exception& problem) {
        failure_ = problem.what();
    }
    if (stopped)
        reporter_.info(fmt::format("stopping: {}", film_ ? "finishing the film" : "keeping what there is"));
    close_film();
    close_state();
    record_.status = !failure_.empty() ? RunStatus::failed
                     : stopped         ? RunStatus::interrupted
                                       : RunStatus::complete;
    record_.exit_status = !failure_.empty() ? 1 : stopped ? 128 + stop_signal() : 0;
    close_record();
    report_end();
    std::printf("%s\n", folder_.path().c_str());
    return *record_.exit_status;
}

void MovieRun::describe() {
    std::vector<std::string> warnings = plan_.warnings;
    if (wants_pictures()) {
        const std::vector<std::string> strobes = strobe_warnings(scene_.film, scene_.drive);
        warnings.insert(warnings.end(), strobes.begin(), strobes.end());
    }
    for (const std::string& warning : warnings) reporter_.warning(warning);
    begin_record(warnings);
    replace_file(folder_.path() / "scene.toml", resolved_scene(scene_, plan_));
    reporter_.detail(fmt::format("{}: {} grains, {} steps of {:.4g} s ({})", scene_.file, scene_.grains(),
                                 plan_.steps, plan_.clock.step, plan_.step_reason));
    reporter_.detail(fmt::format("threads: engine {}, raster {}, encoder {}", simulation_->threads(),
                                 threads_.raster, threads_.encoder));
}

void MovieRun::begin_record(const std::vector<std::string>& warnings) {
    record_.command = options_.command;
    record_.scene_file = scene_.file;
    record_.version = build_info::version;
    record_.commit = build_info::commit;
    record_.compiler = build_info::compiler;
    record_.build_flags = build_info::flags;
    record_.libraries = library_versions();
    record_.vector = vector_instructions();
    record_.seed = scene_.run.seed;
    record_.engine_threads = simulation_->threads();
    record_.raster_threads = wants_pictures() ? threads_.raster : 0;
    record_.encoder_threads = wants_pictures() ? threads_.encoder : 0;
    record_.started = utc_now();
    record_.grains = scene_.grains();
    record_.steps_planned = plan_.steps;
    record_.step = plan_.clock.step;
    record_.warnings = warnings;
    write_run_json(folder_.path() / "run.json", record_);
}

bool MovieRun::pack() {
    const auto timer = times_.during("packing");
    Stopwatch packing;
    const auto watcher = [&](const PackingProgress& now) {
        Progress progress;
        const bool growing = now.stage == PackingProgress::Stage::growing;
        progress.stage = growing ? Progress::Stage::growing : Progress::Stage::settling;
        progress.done = now.done;
        if (packing.seconds() > 0.5) {
            progress.particle_steps_per_second =
                static_cast<double>(now.steps) * static_cast<double>(scene_.grains()) / packing.seconds();
        }
        progress.elapsed = watch_.seconds();
        reporter_.progress(progress);
        return stop_signal() == 0;
    };
    const PackingResult packing_result = simulation_->pack(watcher);
    if (!packing_result.finished) return false;
    first_step_ = simulation_->step();
    if (first_step_ >= plan_.steps) {
        throw UserError(
            fmt::format("{}: the start is at step {} already and the run ends at step {}; raise run.duration",
                        scene_.where("run.duration"), first_step_, plan_.steps));
    }
    packed_ = true;
    reporter_.detail(fmt::format("packed {} grains: {:.3g} s of settling, solid fraction {:.3f}",
                                 simulation_->grains(), packing_result.settle_time,
                                 packing_result.solid_fraction));
    if (!packing_result.settled) {
        reporter_.warning(
            fmt::format("{}: the bed still moves after {:.3g} s of settling ({:.2g} J a grain); raise "
                        "start.settle_limit",
                        scene_.where("start.settle_limit"), packing_result.settle_time,
                        packing_result.kinetic_per_grain));
    }
    return stop_signal() == 0;
}

void MovieRun::open_files() {
    files_.emplace(folder_.path(), scene_, plan_, simulation_->grains());
    if (!wants_pictures()) return;
    FilmOptions film;
    film.folder = folder_.path();
    film.film = options_.film;
    film.frames = options_.frames;
    film.raster_threads = threads_.raster;
    film.encoder_threads = threads_.encoder;
    film_ = std::make_unique<FilmMaker>(scene_, film);
}

bool MovieRun::vibrate() {
    open_files();
    Agenda agenda(std::move(shots_), plan_.trajectory_every, plan_.measures_every, first_step_, plan_.steps);
    pictures_planned_ = agenda.shots();
    vibrating_.emplace();
    since_checkpoint_ = Stopwatch();
    while (const std::optional<Stop> stop = agenda.next()) {
        if (!advance_to(stop->step)) return false;
        serve(*stop);
        show_progress();
    }
    return true;
}

bool MovieRun::advance_to(std::int64_t target) {
    while (simulation_->step() < target) {
        if (stop_signal() != 0) return false;
        const std::int64_t from = simulation_->step();
        const std::int64_t to = std::min(target, from + pace_.steps());
        Stopwatch stretch;
        {
            const auto timer = times_.during("engine");
            simulation_->advance(to);
        }
        const double seconds = stretch.seconds();
        pace_.took(to - from, seconds);
        const double work = static_cast<double>(to - from) * static_cast<double>(simulation_->grains());
        particle_steps_ += work;
        rate_.add(work, seconds);
        if (since_checkpoint_.seconds() > checkpoint_interval) save_checkpoint();
        show_progress();
    }
    return stop_signal() == 0;
}

void MovieRun::serve(const Stop& stop) {
    if (stop.measures) {
        const auto timer = times_.during("measuring");
        files_->add_measures(simulation_->measures());
    }
    if (!stop.trajectory && stop.segments.empty()) return;
    const auto frame = std::make_shared<const Frame>(simulation_->frame());
    if (stop.trajectory) {
        const auto timer = times_.during("writing");
        files_->add_frame(*frame, *simulation_);
    }
    const auto timer = times_.during("waiting for the film");
    for (const int segment : stop.segments) {
        const FilmSegment& rule = scene_.film.segments.at(static_cast<std::size_t>(segment));
        film_->take(frame, playback_caption(rule, scene_.drive, scene_.film.rate));
    }
}

void MovieRun::show_progress() {
    const std::int64_t step = simulation_->step();
    Progress progress;
    progress.stage = Progress::Stage::vibrating;
    progress.done = static_cast<double>(step - first_step_) / static_cast<double>(plan_.steps - first_step_);
    progress.time = plan_.clock.time(step);
    progress.end = plan_.clock.time(plan_.steps);
    progress.particle_steps_per_second = rate_.value();
    progress.frames = film_ ? film_->frames_done() : 0;
    progress.frames_planned = pictures_planned_;
    progress.elapsed = watch_.seconds();
    const double vibrating = vibrating_->seconds();
    if (progress.done > 0 && vibrating > 1)
        progress.remaining = vibrating * (1 - progress.done) / progress.done;
    reporter_.progress(progress);
}

void MovieRun::save_checkpoint() {
    const auto timer = times_.during("writing");
    simulation_->save_checkpoint(folder_.path() / "checkpoint.grs");
    since_checkpoint_ = Stopwatch();
}

}  // namespace grainreel
