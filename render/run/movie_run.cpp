#include "render/run/movie_run.hpp"

#include <utility>

#include <fmt/format.h>

#include "engine/base/team.hpp"
#include "render/film/sampling/film_limits.hpp"
#include "render/run/segregation_text.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

Pictures schedule(const FilmedScene& scene, const Plan& plan, bool wanted) {
    if (!wanted) return {};
    const bool may_leave_out = true;
    return {instants_of(scene, plan.clock, plan.steps), scene.film.segments, may_leave_out};
}

ThreadPlan threads_for(const FilmedScene& scene, bool film) {
    const int processors = scene.run.threads > 0 ? scene.run.threads : usable_processors();
    return plan_threads(processors, film, scene.grains());
}

Progress::Stage stage_of(const PackingProgress& packing) {
    switch (packing.stage) {
        case PackingProgress::Stage::growing:
            return Progress::Stage::growing;
        case PackingProgress::Stage::raining:
            return Progress::Stage::raining;
        case PackingProgress::Stage::settling:
            break;
    }
    return Progress::Stage::settling;
}

}  // namespace

MovieRun::MovieRun(const FilmRequest& request, RunListener& listener, const FilmedScene& scene,
                   const Plan& plan)
    : FilmRun(request, listener),
      pictures_(schedule(scene, plan, wants_pictures())),
      run_(scene, plan, threads_for(scene, wants_pictures()).engine) {
    threads_ = threads_for(scene, wants_pictures());
    check_film(scene, static_cast<std::int64_t>(pictures_.instants.size()));
    make_folder({scene.name, request.base, request.out, request.force});
}

MovieRun::MovieRun(const FilmRequest& request, RunListener& listener, const FilmedScene& scene,
                   const Plan& plan, ResumePoint point, std::shared_ptr<FolderLock> lock)
    : FilmRun(request, listener),
      pictures_(schedule(scene, plan, wants_pictures())),
      run_(scene, plan, std::move(point)) {
    threads_ = threads_for(scene, wants_pictures());
    check_film(scene, static_cast<std::int64_t>(pictures_.instants.size()));
    make_folder({.name = scene.name, .out = request.out, .goes_on = std::move(lock)});
    run_.keep_former(folder_->lock(), pictures_, record_.version);
    mark_begun();
}

bool MovieRun::work() {
    describe();
    if (!run_.packed() && !pack()) return false;
    mark_begun();
    if (request_.page) run_.keep_key_moments();
    run_.start(pictures_);
    pictures_planned_ = run_.shots();
    open_film(run_.scene());
    vibrating_.emplace();
    holds_.emplace(run_.scene().film);
    const auto go_on = [this] {
        show_progress();
        tell_news();
        return listener_.stop_signal() == 0;
    };
    while (const std::optional<Taken> picture = run_.next(go_on)) take(*picture);
    tell_news();
    return listener_.stop_signal() == 0;
}

void MovieRun::describe() {
    const FilmedScene& scene = run_.scene();
    std::vector<std::string> warnings = run_.plan().warnings;
    if (wants_pictures()) {
        for (const std::vector<std::string>& found :
             {pace_warnings(scene, run_.plan().clock),
              strobe_warnings(scene.film, scene.drive, scene.run.duration),
              film_warnings(scene, static_cast<std::int64_t>(pictures_.instants.size()))})
            warnings.insert(warnings.end(), found.begin(), found.end());
    }
    run_.describe(record_);
    begin_record(warnings);
    run_.use_folder(folder_->lock(), record_.version);
    listener_.detail(fmt::format("{}: {} grains, {} steps of {:.4g} s ({})", scene.file, scene.grains(),
                                 run_.plan().steps, run_.plan().clock.step, run_.plan().step_reason));
    listener_.detail(fmt::format("threads: engine {}, raster {}, encoder {}", run_.simulation().threads(),
                                 threads_.raster, threads_.encoder));
}

bool MovieRun::pack() {
    Stopwatch packing;
    const auto watcher = [&](const PackingProgress& now) {
        Progress progress;
        progress.stage = stage_of(now);
        progress.done = now.done;
        if (packing.seconds() > 0.5) {
            progress.particle_steps_per_second = static_cast<double>(now.steps) *
                                                 static_cast<double>(run_.scene().grains()) /
                                                 packing.seconds();
        }
        progress.elapsed = watch_.seconds();
        listener_.progress(progress);
        return listener_.stop_signal() == 0;
    };
    if (!run_.pack(watcher)) return false;
    listener_.detail(run_.packing_text());
    if (const auto warning = run_.packing_warning()) listener_.warning(*warning);
    return listener_.stop_signal() == 0;
}

void MovieRun::take(const Taken& picture) {
    const FilmedScene& scene = run_.scene();
    const auto timer = times_.during("waiting for the film");
    const FilmSegment& rule = scene.film.segments.at(static_cast<std::size_t>(picture.segment));
    const FilmSegment pace = played(spanning(rule, picture.periods), scene.film.rate, run_.plan().clock);
    film_->take(picture.frame, playback_caption(pace, scene.drive, scene.film.rate));
    film_times_.add(*picture.frame, 1 + holds_->begin_at(picture.frame->time));
}

void MovieRun::tell_news() {
    const std::vector<std::string> news = run_.news();
    for (; told_ < news.size(); ++told_) {
        listener_.warning(news[told_]);
        record_.warnings.push_back(news[told_]);
    }
}

void MovieRun::show_progress() {
    const Plan& plan = run_.plan();
    Progress progress;
    progress.stage = Progress::Stage::vibrating;
    progress.done = run_.done();
    progress.time = plan.clock.time(run_.simulation().step());
    progress.end = plan.clock.time(plan.steps);
    progress.particle_steps_per_second = run_.recent_speed();
    progress.frames = film_ ? film_->frames_done() : 0;
    progress.frames_planned = frames_planned_;
    progress.elapsed = watch_.seconds();
    const double vibrating = vibrating_->seconds();
    if (progress.done > 0 && vibrating > 1)
        progress.remaining = vibrating * (1 - progress.done) / progress.done;
    listener_.progress(progress);
}

void MovieRun::keep_state() {
    run_.close(failure_);
}

void MovieRun::film_closed(std::int64_t frames) {
    film_times_.write(folder_->path() / kFilmTimes, frames);
}

void MovieRun::conclude() {
    run_.conclude(record_);
    record_.wall_seconds = run_.times().all();
}

std::string MovieRun::stopped_text() const {
    return fmt::format("stopped at {:.2f} of {:.2f} s", record_.simulated,
                       run_.plan().clock.time(run_.plan().steps));
}

void MovieRun::report_written() {
    listener_.info(fmt::format("wrote {}: {}{}, log.txt{}", folder_->path().string(), film_files_text(),
                               run_.files_text(), page_text()));
    report_segregation();
    listener_.info(
        fmt::format("took {}: packing {}, engine {} ({:.1f} M particle-steps/s), film {}",
                    duration_text(watch_.seconds()), duration_text(run_.times().of("packing")),
                    duration_text(run_.times().of("engine")), run_.speed() * 1e-6,
                    duration_text(times_.of("waiting for the film") + times_.of("finishing the film"))));
}

void MovieRun::report_segregation() {
    const FilmedScene& scene = run_.scene();
    const RunFiles& files = *run_.files();
    if (scene.species.size() < 2 || !files.last_measures()) return;
    const LateMeans& late = files.late_measures();
    const std::string text = segregation_text(scene, *files.first_measures(), late.means(), late.over());
    if (!text.empty()) listener_.info(text);
}

}  // namespace grainreel
