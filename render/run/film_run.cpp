#include "render/run/film_run.hpp"

#include <sys/resource.h>

#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/film/production/caption_holds.hpp"
#include "render/film/sampling/film_limits.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

constexpr int signal_base = 128;

std::int64_t peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

}  // namespace

FilmRun::FilmRun(const FilmRequest& request, RunListener& listener) : request_(request), listener_(listener) {
    static_cast<ProgramInfo&>(record_) = request.program;
    record_.command = request.command;
}

FilmRun::~FilmRun() = default;

void FilmRun::check_film(const FilmedScene& scene, std::int64_t frames) const {
    if (request_.to_stdout && !(request_.film && scene.film.format == FilmFormat::y4m))
        throw UserError("--out -: stdout takes a film in y4m alone; add --format y4m, or name a folder");
    if (request_.film) check_max_size(scene, frames);
}

void FilmRun::make_folder(RunFolderRequest request) {
    request.command = request_.command;
    folder_.emplace(request);
    log_.emplace(folder_->path() / "log.txt", request.goes_on != nullptr);
    listener_.keep_log(&*log_);
}

FilmRun::Ended FilmRun::run() {
    bool stopped = false, mistaken = false;
    try {
        stopped = !work();
    } catch (const UserError& mistake) {
        if (!begun_) {
            listener_.keep_log(nullptr);
            folder_->discard();
            throw;
        }
        note_folder();
        mistaken = !failure_.any();
        failure_.note(mistake.what());
    } catch (const std::exception& problem) {
        note_folder();
        failure_.note(problem.what());
    }
    if ((stopped || failure_.any()) && is_behind_former()) return end_as_before(mistaken);
    if (stopped)
        listener_.info(fmt::format("stopping: {}", film_ ? "finishing the film" : "keeping what there is"));
    find_folder();
    keep_state();
    // What was asked to stop says so from here on: a third signal may end it while the film is finished.
    if (stopped) close_record(stopped);
    close_film();
    find_folder();
    if (has_film_ && has_folder_) failure_.attempt([&] { film_closed(film_report_.frames); });
    page_is_missing(request_.page && has_folder_ && !stopped && !failure_.any());
    close_record(stopped);
    if (record_.status == RunStatus::complete) folder_->remove_previous();
    make_page();
    report_end();
    return {*record_.exit_status, has_folder_ ? std::optional(folder_->path()) : std::nullopt};
}

// Of a run that goes on and did not come to where it was.
FilmRun::Ended FilmRun::end_as_before(bool mistaken) {
    film_.reset();
    if (failure_.any()) listener_.error(failure_.what());
    const std::string folder = folder_->path().string();
    try {
        folder_->lock().check_there();
        put_back();
        listener_.info(
            fmt::format("{}: is as it was before, since the run did not come past its former end", folder));
    } catch (const RunError& problem) {
        listener_.error(problem.what());
        listener_.info(fmt::format("{}: the next `resume` puts back what the run was", folder));
        failure_.note(problem.what());
    }
    const int status = mistaken ? 2 : failure_.any() ? 1 : signal_base + listener_.stop_signal();
    return {status, mistaken ? std::nullopt : std::optional(folder_->path())};
}

void FilmRun::mark_begun() {
    begun_ = true;
    listener_.keep_before_exit();
}

// A folder that is gone is why anything else failed.
void FilmRun::note_folder() {
    failure_.attempt([&] { folder_->lock().check_there(); });
}

// Where the folder is now. Its film is left before its name changes: the film's threads use the old one.
void FilmRun::find_folder() {
    if (folder_->lock().is_there()) return;
    note_folder();
    close_film();
    has_folder_ = folder_->follow();
}

void FilmRun::settle_status(bool stopped) {
    record_.status = failure_.any() ? RunStatus::failed
                     : stopped      ? RunStatus::interrupted
                                    : RunStatus::complete;
    record_.exit_status = failure_.any() ? 1 : stopped ? signal_base + listener_.stop_signal() : 0;
}

void FilmRun::begin_record(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) listener_.warning(warning);
    record_.started = utc_now();
    record_.raster_threads = wants_pictures() ? threads_.raster : 0;
    record_.encoder_threads = wants_pictures() ? threads_.encoder : 0;
    record_.warnings = warnings;
    write_run_json(folder_->path() / "run.json", record_);
}

void FilmRun::open_film(const FilmedScene& scene, DrawerMaker draw) {
    if (!wants_pictures()) return;
    FilmOptions film;
    film.folder = folder_->path();
    film.film = request_.film;
    film.frames = request_.frames;
    film.page_copy = request_.page != nullptr;
    film.to_stdout = request_.to_stdout;
    film.raster_threads = threads_.raster;
    film.encoder_threads = threads_.encoder;
    film.take_turns = threads_.take_turns;
    film.gl = request_.gl;
    film.pictures = pictures_planned_;
    film.start = start_;
    frames_planned_ = pictures_planned_ + held_frames(scene.film);
    film.check_folder = [this] { folder_->lock().check_there(); };
    film_ = draw ? std::make_unique<FilmMaker>(scene, film, std::move(draw))
                 : std::make_unique<FilmMaker>(scene, film);
    record_.gl = film_->drawer();
    listener_.detail("drawn with " + record_.gl);
}

void FilmRun::close_film() {
    if (!film_) return;
    failure_.attempt([&] {
        const auto timer = times_.during("finishing the film");
        film_report_ =
            film_->finish([this] { return listener_.in_a_hurry() || !folder_->lock().is_there(); });
        if (!film_report_.complete) listener_.info("note: the film was left as it is");
        for (const std::string& note : film_report_.notes) listener_.info("note: " + note);
    });
    film_report_.frames = film_->frames_done();
    film_.reset();
    has_film_ = request_.film && !request_.to_stdout;
    times_.add("drawing (beside the engine)", film_report_.draw_seconds);
    times_.add("encoding (beside the engine)", film_report_.encode_seconds);
}

void FilmRun::close_record(bool stopped) {
    settle_status(stopped);
    conclude();
    settle_status(stopped);
    record_.error = failure_.what();
    record_.finished = utc_now();
    record_.film_frames = film_report_.frames;
    if (film_) record_.film_frames.reset();  // what of it is on disk shows when it is closed
    record_.encoder = film_report_.encoder;
    record_.peak_memory = peak_memory();
    if (has_folder_) failure_.attempt([&] { write_record(); });
    settle_status(stopped);
}

// The run counts as complete only with its page.
void FilmRun::write_record() {
    RunRecord now = record_;
    if (now.status == RunStatus::failed) now.missing.clear();
    if (!now.missing.empty() && now.status == RunStatus::complete) {
        now.status = RunStatus::running;
        now.exit_status.reset();
    }
    for (const auto& time : times_.all()) now.wall_seconds.push_back(time);
    now.wall_seconds.emplace_back("total", watch_.seconds());
    write_run_json(folder_->path() / "run.json", now);
}

// Of a run whose other files are closed, also of one that failed. A run without its page has failed at
// nothing.
void FilmRun::make_page() {
    if (!request_.page || !has_folder_) return;
    if (listener_.in_a_hurry()) return stop_before_page();
    if (!begun_ && !failure_.any()) return;  // stopped before there was anything to show
    const Stopwatch making;
    const auto go_on = [&](double share) {
        Progress progress;
        progress.stage = Progress::Stage::paging;
        progress.done = share;
        progress.elapsed = watch_.seconds();
        listener_.progress(progress);
        return !listener_.in_a_hurry() && folder_->lock().is_there();
    };
    try {
        record_.page = request_.page(folder_->path(), go_on).value_or("");
        if (record_.page.empty()) return stop_before_page();
        times_.add("making the page", making.seconds());
        page_is_missing(false);
        write_record();
    } catch (const std::exception& problem) {
        listener_.warning(fmt::format("the run has no page: {}", problem.what()));
        page_is_missing(false);
        failure_.attempt([&] { write_record(); });
    }
}

void FilmRun::page_is_missing(bool missing) {
    record_.missing.clear();
    if (missing) record_.missing.emplace_back(kPageIsMissing);
}

// Who is in a hurry goes without the page, which `resume` makes.
void FilmRun::stop_before_page() {
    if (record_.missing.empty() || !folder_->lock().is_there()) return;
    settle_status(true);
    failure_.attempt([&] { write_record(); });
}

std::string FilmRun::page_text() const {
    return record_.page.empty() ? "" : ", " + record_.page;
}

void FilmRun::report_end() {
    const std::string folder = folder_->path().string();
    if (failure_.any()) {
        record_.exit_status = 1;
        listener_.error(failure_.what());
        if (has_folder_) listener_.info(fmt::format("what was made until then is in {}", folder));
    } else if (record_.status == RunStatus::interrupted) {
        listener_.info(fmt::format("{}; what was made is in {}{}", stopped_text(), folder,
                                   begun_ ? "" : " (still packing: no film)"));
    }
    if (begun_ && !failure_.any()) report_written();
    if (!folder_->previous().empty()) {
        listener_.info(
            fmt::format("the run that was to be replaced is kept in {}", folder_->previous().string()));
    }
}

void FilmRun::show_drawing() {
    Progress progress;
    progress.stage = Progress::Stage::drawing;
    progress.frames = film_->frames_done();
    progress.frames_planned = frames_planned_;
    progress.done = static_cast<double>(progress.frames) / static_cast<double>(frames_planned_);
    progress.elapsed = watch_.seconds();
    if (progress.frames > 0 && progress.elapsed > 1)
        progress.remaining = progress.elapsed * (1 - progress.done) / progress.done;
    listener_.progress(progress);
}

std::string FilmRun::film_files_text() const {
    std::string text;
    if (!film_report_.file.empty())
        text += fmt::format("{} ({} frames), ", film_report_.file, film_report_.frames);
    if (request_.to_stdout) text += fmt::format("to stdout {} frames, ", film_report_.frames);
    if (film_report_.poster) text += "poster.png, ";
    if (film_report_.sheet) text += "sheet.png, ";
    if (film_report_.pictures) text += fmt::format("frames/ ({} pictures), ", film_report_.frames);
    return text;
}

}  // namespace grainreel
