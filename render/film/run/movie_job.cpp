#include "render/film/run/movie_job.hpp"

#include <utility>

#include <fmt/format.h>

#include "engine/base/team.hpp"
#include "render/film/sampling/film_frames.hpp"

namespace grainreel {

namespace {

Pictures schedule(const FilmRequest& request, const FilmedScene& scene, const Plan& plan) {
    if (!request.film && !request.frames) return {};
    return {.instants = instants_of(scene, plan.clock, plan.steps),
            .segments = scene.film.segments,
            .may_leave_out = true};
}

ThreadPlan threads_for(const FilmRequest& request, const FilmedScene& scene) {
    const int processors = scene.run.threads > 0 ? scene.run.threads : usable_processors();
    return plan_threads(processors, request.film || request.frames, scene.grains());
}

}  // namespace

MovieJob::MovieJob(const FilmRequest& request, Listener& listener, const FilmedScene& scene, const Plan& plan)
    : MovieJob(request, listener, scene, plan, threads_for(request, scene), schedule(request, scene, plan)) {
    check_film();
    new_folder();
}

MovieJob::MovieJob(const FilmRequest& request, Listener& listener, const FilmedScene& scene, const Plan& plan,
                   ResumePoint point, std::shared_ptr<FolderLock> lock)
    : MovieJob(request, listener, scene, plan, std::move(point), schedule(request, scene, plan)) {
    check_film();
    go_on_in(std::move(lock), source_.has_shots(pictures_));
}

MovieJob::MovieJob(const FilmRequest& request, Listener& listener, const FilmedScene& scene, const Plan& plan,
                   const ThreadPlan& threads, Pictures pictures)
    : SceneJob(request, listener, scene, plan, threads.engine),
      pictures_(std::move(pictures)),
      film_(request, desk_),
      source_(scene, driver_) {
    film_.use_threads(threads);
}

MovieJob::MovieJob(const FilmRequest& request, Listener& listener, const FilmedScene& scene, const Plan& plan,
                   ResumePoint point, Pictures pictures)
    : SceneJob(request, listener, scene, plan, std::move(point)),
      pictures_(std::move(pictures)),
      film_(request, desk_),
      source_(scene, driver_) {
    film_.use_threads(threads_for(request, scene));
}

void MovieJob::check_film() const {
    film_.check(source_.scene(), static_cast<std::int64_t>(pictures_.instants.size()));
}

std::vector<std::string> MovieJob::more_warnings() const {
    const FilmedScene& scene = source_.scene();
    std::vector<std::string> warnings;
    if (!film_.wanted()) return warnings;
    for (const std::vector<std::string>& found :
         {pace_warnings(scene, driver_.plan().clock),
          strobe_warnings(scene.film, scene.drive, scene.run.duration),
          film_warnings(scene, static_cast<std::int64_t>(pictures_.instants.size()))})
        warnings.insert(warnings.end(), found.begin(), found.end());
    return warnings;
}

std::string MovieJob::threads_text() const {
    return fmt::format("{}, raster {}, encoder {}", SceneJob::threads_text(), film_.threads().raster,
                       film_.threads().encoder);
}

void MovieJob::start() {
    film_.make_frames_place(source_.scene());
    if (request_.page) source_.keep_key_moments();
    source_.start(pictures_);
    film_.open(source_.scene(), source_.shots());
}

bool MovieJob::next(const RunDriver::GoOn& go_on) {
    const std::optional<Taken> picture = source_.next(go_on);
    if (picture)
        film_.show(*picture, source_.scene().film.segments.at(static_cast<std::size_t>(picture->segment)),
                   driver_.plan().clock);
    return picture.has_value();
}

void MovieJob::add_progress(Progress& progress) const {
    progress.frames = film_.frames_done();
    progress.frames_planned = film_.frames_planned();
}

void MovieJob::side_work_closed() {
    film_.write_times();
    SceneJob::side_work_closed();
}

void MovieJob::put_back() {
    source_.close();
    SceneJob::put_back();
}

std::string MovieJob::side_times_text() const {
    return fmt::format(", film {}", duration_text(desk_.times.of("waiting for the film") +
                                                  desk_.times.of("finishing the film")));
}

}  // namespace grainreel
