#include "render/film/run/follow_job.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/files/run_names.hpp"
#include "engine/handover/peer_process.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/film/sources/film_needs.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/film/sources/recorded_scene.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

constexpr double kReading = 0.25;  // s, longest time of reading before it looks for something to draw
constexpr double kPause = 10;  // least pause before the run is opened again, divided by the time of opening

// Takes a free working folder. The folders are numbered, because several programs may follow one job.
std::unique_ptr<ReturningFolder> free_folder(const fs::path& folder) {
    for (int number = 1;; ++number)
        if (auto made = ReturningFolder::take(folder, fmt::format(".following-{}", number))) return made;
}

void check_options(const FilmRequest& request) {
    if (!request.film && !request.frames)
        throw UserError("--no-film: leaves nothing to draw; add --frames for the pictures");
}

}  // namespace

FollowJob::FollowJob(const FilmRequest& request, const FollowRequest& what, Listener& listener)
    : FilmJob(request, listener),
      what_(what),
      facts_((check_options(request), read_handover(what.from))),
      scene_(scene_of_run(what.from, what.sets)),
      plan_(make_plan(scene_)),
      returning_(free_folder(what.from)) {
    if (const auto lack = lacking_elsewhere(scene_))
        throw UserError(fmt::format("{}: {}", what.from.string(), *lack));
    const std::int64_t pictures = std::ssize(film_schedule(scene_, plan_.clock, plan_.steps));
    film_.check(scene_, pictures);
    film_.use_threads(drawing_threads(scene_.run.threads));
    keep_mesh_files(scene_, returning_->path());
    fs::copy_file(what.from / "scene.toml", returning_->path() / "scene.toml");
    back_ = std::make_unique<ReturnedRun>(returning_->path(), scene_, plan_, facts_, request.program.version);
    const JobEnd before = job_end(what.from, facts_);
    job_ = before.job;
    wait_for_first();
    // Without a moment there is nothing from which a job could go on.
    earlier_ = before.ended && before.job == job_;
    make_folder({scene_.name + "-render", what.beside, request.out, request.force});
}

void FollowJob::wait_for_first() {
    const auto take = [&] {
        try {
            return back_->take_next();
        } catch (const std::exception&) {
            if (!job_goes_on()) throw;
            return false;
        }
    };
    while (!take()) {
        const JobEnd job = look_at_job();
        if (job.ended && !take()) {
            if (!job.failure.empty())
                throw RunError(fmt::format("{}: has no whole moment; {}", facts_.dump.string(), job.failure));
            throw UserError(
                fmt::format("{}: has no whole moment, and the job has ended", facts_.dump.string()));
        }
        if (job.ended) break;
        if (idle_.seconds() >= what_.idle || stopped())
            throw UserError(fmt::format(
                "{}: is not there, or has no whole moment yet (--follow waited {:.3g} s); has the "
                "job begun?",
                facts_.dump.string(), idle_.seconds()));
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    idle_ = Stopwatch();
}

JobEnd FollowJob::look_at_job() {
    JobEnd now = job_end(what_.from, facts_);
    if (!now.ended || now.job != job_) earlier_ = false;
    if (!now.job.empty() && now.job != job_) {
        job_ = now.job;
        if (back_->last() == nullptr || now.goes_on)
            back_->read_anew();
        else
            unsound_ = fmt::format(
                "{}: a new job began from the start, and its grains go other ways; begin "
                "--follow again",
                what_.from.string());
    }
    now.ended = now.ended && !earlier_;
    return now;
}

bool FollowJob::job_goes_on() {
    const std::string before = job_;
    const JobEnd now = look_at_job();
    if (job_ != before) return true;
    // run.sh takes the status away before it cuts the dump.
    const bool cut = !now.begun && back_->dump_is_shorter();
    if (cut) back_->read_anew();
    return cut;
}

bool FollowJob::read_some() {
    const auto timer = desk_.times.during("reading");
    const Stopwatch reading;
    bool some = false;
    try {
        while (unsound_.empty() && reading.seconds() < kReading && !stopped() && back_->take_next())
            some = true;
    } catch (const std::exception& wrong) {  // what was read so far is still drawn
        if (!job_goes_on()) unsound_ = wrong.what();
    }
    if (some) idle_ = Stopwatch();
    return some;
}

FollowJob::End FollowJob::end_now() {
    const JobEnd job = look_at_job();
    if (!unsound_.empty()) return End::unsound;
    if (back_->last()->step >= facts_.last) return End::whole;
    if (job.ended) return End::job;
    return idle_.seconds() >= what_.idle ? End::idle : End::none;
}

std::vector<std::string> FollowJob::warnings() const {
    std::vector<std::string> all = source_->news();
    for (const std::vector<std::string>& more :
         {pace_warnings(scene_, plan_.clock), strobe_warnings(scene_.film, scene_.drive, scene_.run.duration),
          film_warnings(scene_, std::ssize(film_schedule(scene_, plan_.clock, plan_.steps)))})
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

// Opens the run's files again, as they are now. An open run does not see moments that are written later.
void FollowJob::open_anew() {
    constexpr bool replay = false;
    const Stopwatch opening;
    source_ = std::make_unique<StoredShots>(returning_->path(), what_.sets, replay);
    opened_at_ = back_->frames();
    opening_ = opening.seconds();
    since_opened_ = Stopwatch();
}

void FollowJob::draw(const Taken& picture) {
    if (!film_.is_open()) {
        const std::int64_t pictures = std::ssize(film_schedule(scene_, plan_.clock, plan_.steps));
        film_.open(scene_, pictures, picture.frame);
    }
    film_.show(picture, source_->segments().at(static_cast<std::size_t>(picture.segment)), plan_.clock);
    film_.show_progress();
}

bool FollowJob::draw_new() {
    if (back_->frames() > opened_at_) open_anew();
    const std::vector<Due> shots = source_->shown_shots(shown_);
    if (shots.empty()) return !stopped();
    const auto go_on = [this] {
        desk_.folder->lock().check_there();
        return !stopped();
    };
    source_->start(shots, source_->segments());
    while (std::optional<Taken> picture = source_->next(go_on)) {
        draw(*picture);
        shown_ = picture->frame->step;
    }
    return !stopped();
}

bool FollowJob::work() {
    mark_begun();
    desk_.record.scene_file = scene_.file;
    open_anew();
    begin_record(warnings());
    if (earlier_ && back_->last()->step < facts_.last)
        desk_.listener.info(
            fmt::format("{}: the job has ended before; if none goes on, the film ends after "
                        "{:.3g} s (--idle)",
                        what_.from.string(), what_.idle));
    desk_.listener.info(
        fmt::format("{}: follows {} until {:.6g} s; the film ends with the job, when nothing "
                    "new has come for {:.3g} s, or with Ctrl-C",
                    facts_.dump.string(), name_of(facts_.engine), plan_.clock.time(facts_.last), what_.idle));
    End end = End::none;
    while (end == End::none) {
        // Whether the job has ended is asked before its dump is read. A job that had ended by then writes no
        // more. If reading then finds nothing, all of the dump was read.
        const End now = end_now();
        const bool some = read_some();
        if (stopped()) return false;
        if (!some) end = now;
        const bool due = since_opened_.seconds() >= kPause * opening_;
        if (end != End::none || (due && back_->frames() > opened_at_)) {
            if (!draw_new()) return false;
        } else if (!some) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }
    finish(end);
    return true;
}

// Leaves the run's files in the folder of the hand-over, and tells why the film has an end.
void FollowJob::finish(End end) {
    const double until = back_->last()->time, wanted = plan_.clock.time(facts_.last);
    desk_.record.drawn = {{what_.from.string(), std::ssize(source_->film().shots()),
                           source_->run().moments().front().time, until}};
    RunJson of_run;
    back_->close(of_run);
    source_.reset();
    back_.reset();
    returning_->move_out();
    returning_.reset();
    if (end == End::whole) return;
    const JobEnd job = job_end(what_.from, facts_);
    if (end == End::unsound) throw RunError(unsound_);
    const std::string far = came_so_far(what_.from, facts_, until, wanted);
    if (!job.failure.empty()) throw RunError(far);
    desk_.listener.warning(
        end == End::idle ? fmt::format("nothing new has come for {:.3g} s; {}", what_.idle, far) : far);
}

void FollowJob::side_work_closed() {
    film_.write_times();
}

std::string FollowJob::stopped_text() const {
    return fmt::format("stopped after {}", counted(film_.result().frames, "frame"));
}

void FollowJob::report_written() {
    desk_.listener.info(fmt::format("wrote {}: {}run.json, log.txt", folder().string(), film_.files_text()));
}

}  // namespace grainreel
