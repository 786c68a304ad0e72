#include "render/film/run/follow_run.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/run/import/import_run.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/film/sources/recorded_scene.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;
using Steady = std::chrono::steady_clock;

double seconds_since(Steady::time_point begin) {
    return std::chrono::duration<double>(Steady::now() - begin).count();
}

// Sleeps in short naps, so that Ctrl-C is noticed.
void nap(double seconds, const Listener& listener) {
    const Steady::time_point begin = Steady::now();
    while (seconds_since(begin) < seconds && listener.stop_signal() == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

// Opens the files as they are now; null while they hold no complete frame.
std::unique_ptr<ForeignArchive> opened(const FollowRequest& what) {
    std::error_code ignored;
    if (!is_foreign(what.from)) return nullptr;
    auto frames = std::make_unique<ForeignArchive>(what.from, what.reading);
    return frames->moments().empty() ? nullptr : std::move(frames);
}

std::unique_ptr<ForeignArchive> first_frames(const FollowRequest& what, Listener& listener) {
    const Steady::time_point begin = Steady::now();
    std::string why = what.from.string() + ": is not there, or holds no frame yet";
    while (seconds_since(begin) < what.idle && listener.stop_signal() == 0) {
        try {
            if (auto frames = opened(what)) return frames;
        } catch (const UserError& not_yet) {
            why = not_yet.what();  // may be no mistake but a header that is half written
        }
        nap(0.5, listener);
    }
    throw UserError(fmt::format("{} (--follow waited {:.3g} s)", why, what.idle));
}

// The scene that these frames would get when imported.
FilmedScene scene_of(const FollowRequest& what, const FilmRequest& request) {
    ImportRequest import;
    import.from = what.from;
    import.reading = what.reading;
    import.program_version = request.program.version;
    return scene_of_run(cached_import(import).folder, what.sets);
}

std::vector<std::string> species_of(const ForeignArchive& frames) {
    std::vector<std::string> names;
    for (const WorldSpecies& species : frames.world().species) names.push_back(species.name);
    return names;
}

void check_options(const FollowRequest& what, const FilmRequest& request) {
    if (!what.reading.container.empty())
        throw UserError(
            "--container: its walls move with the drive, which --follow does not do; leave one out");
    for (const Assignment& set : what.sets)
        if (set.key().rfind("film.walls.colour", 0) == 0 && set.value() != "plain")
            throw UserError(fmt::format(
                "{}: stress and wear of walls are known once all files are read; leave out --follow",
                set.place()));
    if (!request.film && !request.frames)
        throw UserError("--no-film: leaves nothing to draw; add --frames for the pictures");
}

}  // namespace

FollowRun::FollowRun(const FilmRequest& request, const FollowRequest& what, Listener& listener)
    : FilmJob(request, listener),
      what_(what),
      frames_((check_options(what, request), first_frames(what, listener))),
      scene_(scene_of(what, request)) {
    film_.check(scene_, static_cast<std::int64_t>(frames_->moments().size()));
    film_.use_threads(drawing_threads(scene_.run.threads));
    make_folder({scene_.name + "-render", what.beside, request.out, request.force});
}

// Number of complete frames. A table does not say how many rows a moment has, so its last moment counts only
// when the next one has begun, or at the end.
std::size_t FollowRun::whole_frames(bool at_end) const {
    const bool open = frames_->format().starts_with("table") && frames_->files().size() == 1;
    return frames_->moments().size() - (open && !at_end ? 1 : 0);
}

bool FollowRun::draw_new(bool at_end) {
    for (const std::size_t whole = whole_frames(at_end); drawn_ < whole; ++drawn_) {
        if (desk_.listener.stop_signal() != 0) return false;
        desk_.folder->lock().check_there();
        Shot shot = frames_->grains(drawn_);
        if (needs_touches(scene_.film.shows))
            shot.touches = frames_->touches(drawn_).value_or(std::vector<Link>());
        film_.maker().take(std::make_shared<const Shot>(std::move(shot)), "");
        show_progress();
    }
    return true;
}

// Shows how many of the known pictures are drawn.
void FollowRun::show_progress() {
    Progress progress;
    progress.stage = Progress::Stage::drawing;
    progress.frames = film_.frames_done();
    progress.frames_planned = static_cast<std::int64_t>(frames_->moments().size());
    progress.done = static_cast<double>(progress.frames) / static_cast<double>(progress.frames_planned);
    progress.elapsed = desk_.watch.seconds();
    desk_.listener.progress(progress);
}

void FollowRun::look_again() {
    std::unique_ptr<ForeignArchive> now;
    wrong_.clear();
    try {
        now = opened(what_);
        if (!now) wrong_ = what_.from.string() + ": is not there any more, or holds no frame";
    } catch (const UserError& why) {
        wrong_ = why.what();  // the file may be half written; the next look sees more
    }
    if (!now) return;
    if (now->moments().size() < drawn_)
        throw RunError(
            fmt::format("{}: has {} frames, but {} were drawn; it was truncated or replaced, or its "
                        "run went on from an earlier moment",
                        what_.from.string(), now->moments().size(), drawn_));
    if (species_of(*now) != species_of(*frames_))
        throw RunError(
            fmt::format("{}: has a type that the frames before lacked; name all types by --species",
                        what_.from.string()));
    frames_ = std::move(now);
}

bool FollowRun::work() {
    mark_begun();
    desk_.record.scene_file = what_.from.string();
    begin_record(frames_->news());
    desk_.listener.info(
        fmt::format("{}: {} so far; the film ends {:.3g} s after the last one, or with Ctrl-C",
                    what_.from.string(), counted(frames_->moments().size(), "frame"), what_.idle));
    film_.open(scene_, static_cast<std::int64_t>(frames_->moments().size()),
               std::make_shared<const State>(frames_->first_whole()));
    Steady::time_point last = Steady::now();
    while (true) {
        const std::size_t before = drawn_;
        if (!draw_new(false)) return false;
        if (drawn_ > before) last = Steady::now();
        if (seconds_since(last) >= what_.idle) {
            if (wrong_.empty() && !draw_new(true)) return false;
            if (wrong_.empty()) break;
            throw RunError(fmt::format("{} (after {} of the film; it was truncated or replaced)", wrong_,
                                       counted(drawn_, "frame")));
        }
        const Steady::time_point begin = Steady::now();
        look_again();
        // Looking at many files takes long; the pause keeps it from taking all the time.
        nap(std::clamp(5 * seconds_since(begin), 0.5, 0.25 * what_.idle + 0.5), desk_.listener);
        if (desk_.listener.stop_signal() != 0) return false;
    }
    desk_.record.drawn = {{what_.from.string(), static_cast<std::int64_t>(drawn_),
                           frames_->moments().front().time, frames_->moments().back().time}};
    return true;
}

std::string FollowRun::stopped_text() const {
    return fmt::format("stopped after {}", counted(film_.result().frames, "frame"));
}

void FollowRun::report_written() {
    desk_.listener.info(fmt::format("wrote {}: {}run.json, log.txt", folder().string(), film_.files_text()));
}

}  // namespace grainreel
