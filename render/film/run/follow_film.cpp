#include "render/film/run/follow_film.hpp"

#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/handover/handover_folder.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/film/sources/film_request.hpp"

namespace grainreel {

namespace {

constexpr double kReading = 0.25;  // s, longest time of reading before it looks for something to draw
constexpr double kPause = 10;  // least pause before the run is opened again, divided by the time of opening

void check_options(const FilmRequest& request) {
    if (!request.film && !request.frames)
        throw UserError("--no-film: leaves nothing to draw; add --frames for the pictures");
}

}  // namespace

FollowFilm::FollowFilm(const FilmRequest& request, const FollowRequest& what, Listener& listener)
    : FilmJob(request, listener),
      what_(what),
      followed_((check_options(request), is_handover(what.from)
                                             ? follow_job(what, request.program.version, desk_.listener)
                                             : follow_files(what, request.program.version, desk_.listener))) {
    if (followed_->plan()) check_film();
    followed_->wait_for_first();
    check_film();
    film_.use_threads(drawing_threads(scene().run.threads));
    open_anew();
    idle_ = Stopwatch();
    make_folder({scene().name + "-render", what.beside, request.out, request.force});
}

// The number of the film's pictures, as far as it is known.
std::int64_t FollowFilm::pictures() const {
    const Plan* const plan = followed_->plan();
    return plan ? std::ssize(film_schedule(scene(), plan->clock, plan->steps)) : followed_->frames();
}

std::vector<std::string> FollowFilm::warnings() const {
    std::vector<std::string> all = followed_->news();
    const auto add = [&](const std::vector<std::string>& more) {
        all.insert(all.end(), more.begin(), more.end());
    };
    add(source_->news());
    if (const Plan* const plan = followed_->plan()) {
        add(pace_warnings(scene(), plan->clock));
        add(strobe_warnings(scene().film, scene().drive, scene().run.duration));
        add(film_warnings(scene(), pictures()));
    }
    return all;
}

bool FollowFilm::read_some() {
    const auto timer = desk_.times.during("reading");
    const Stopwatch reading;
    bool some = false;
    while (reading.seconds() < kReading && !stopped() && followed_->take_next()) some = true;
    if (some) idle_ = Stopwatch();
    return some;
}

// Opens the run's files again, as they are now. An open run does not see moments that are written later.
void FollowFilm::open_anew() {
    constexpr bool replay = false;
    const Stopwatch opening;
    source_ = std::make_unique<StoredShots>(followed_->folder(), what_.sets, replay);
    opened_at_ = followed_->frames();
    opening_ = opening.seconds();
    since_opened_ = Stopwatch();
}

// The pictures that can be drawn and are not yet.
std::vector<Due> FollowFilm::due() const {
    if (followed_->plan()) return source_->shown_shots(shown_);
    std::vector<Due> shots;
    const std::vector<State>& moments = source_->run().moments();
    for (std::int64_t k = drawn_; k < std::ssize(moments); ++k) shots.push_back({moments[k].step, 0});
    return shots;
}

void FollowFilm::draw(const Taken& picture) {
    const Plan* const plan = followed_->plan();
    if (!film_.is_open()) film_.open(scene(), pictures(), picture.frame);
    if (plan)
        film_.show(picture, source_->segments().at(picture.segment), plan->clock);
    else
        film_.maker().take(picture.frame, "");
    if (!plan) film_.plan_frames(opened_at_);
    film_.show_progress();
}

bool FollowFilm::draw_new() {
    if (followed_->frames() > opened_at_) open_anew();
    drawn_at_ = opened_at_;
    const std::vector<Due> shots = due();
    if (shots.empty()) return !stopped();
    const auto go_on = [this] {
        desk_.folder->lock().check_there();
        return !stopped();
    };
    source_->start(shots, source_->segments());
    while (std::optional<Taken> picture = source_->next(go_on)) {
        draw(*picture);
        shown_ = picture->frame->step;
        ++drawn_;
    }
    return !stopped();
}

bool FollowFilm::work() {
    mark_begun();
    desk_.record.scene_file = followed_->plan() ? scene().file : what_.from.string();
    begin_record(warnings());
    followed_->tell_begin();
    bool over = false;
    while (!over) {
        // Whether the run is over is asked before its frames are read: by then nothing more is written. If
        // reading then finds nothing, all was read.
        const bool no_more = followed_->is_over(idle_.seconds() >= what_.idle);
        const bool some = read_some();
        if (stopped()) return false;
        over = no_more && !some;
        const bool may_open = since_opened_.seconds() >= kPause * opening_;
        if (over || (may_open && followed_->frames() > drawn_at_)) {
            if (!draw_new()) return false;
            idle_ = Stopwatch();  // drawing may take long
        } else if (!some) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }
    finish();
    return true;
}

void FollowFilm::finish() {
    desk_.record.drawn = {{what_.from.string(), drawn_, source_->run().from(), source_->run().to()}};
    source_.reset();
    followed_->finish();
}

void FollowFilm::side_work_closed() {
    if (followed_->plan()) film_.write_times();
}

std::string FollowFilm::stopped_text() const {
    return fmt::format("stopped after {}", counted(film_.result().frames, "frame"));
}

void FollowFilm::report_written() {
    desk_.listener.info(fmt::format("wrote {}: {}run.json, log.txt", folder().string(), film_.files_text()));
}

}  // namespace grainreel
