#include "render/film/run/folder_film.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <string>
#include <utility>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/run_names.hpp"
#include "render/film/codec/ffmpeg.hpp"
#include "render/film/codec/film_writer.hpp"
#include "render/film/production/picture_files.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sampling/timeline.hpp"

namespace grainreel {

void FolderFilm::check(const FilmedScene& scene, std::int64_t frames) const {
    if (request_.to_stdout && !(request_.film && scene.film.format == FilmFormat::y4m))
        throw UserError("--out -: stdout takes a film in y4m alone; add --format y4m, or name a folder");
    if (wanted()) check_addresses(scene.film);
    if (!request_.film) return;
    check_max_size(scene, frames);
    // A missing library of FFmpeg is reported here, before a packing that takes minutes.
    if (scene.film.format != FilmFormat::png) quiet_ffmpeg();
}

void FolderFilm::make_frames_place(const FilmedScene& scene) const {
    if (!request_.frames && !(request_.film && scene.film.format == FilmFormat::png)) return;
    desk_.folder->lock().check_there();
    make_frames_folder(desk_.folder->path());
}

void FolderFilm::open(const FilmedScene& scene, std::int64_t pictures, StatePtr start, DrawerMaker draw) {
    if (!wanted()) return;
    desk_.folder->lock()
        .check_there();  // otherwise the film might begin in another folder that has its name now
    FilmOptions film;
    film.folder = desk_.folder->path();
    film.film = request_.film;
    film.frames = request_.frames;
    film.page_copy = request_.page != nullptr;
    film.to_stdout = request_.to_stdout;
    film.raster_threads = threads_.raster;
    film.encoder_threads = threads_.encoder;
    film.take_turns = threads_.take_turns;
    film.gl = request_.gl;
    film.pictures = pictures;
    film.start = std::move(start);
    film.extent = extent_;
    drive_ = scene.drive;
    rate_ = scene.film.rate;
    wording_ = scene.film.wording;
    holds_.emplace(scene.film);
    frames_planned_ = frames_here_.value_or(pictures + held_frames(scene.film));
    film.check_folder = [this] { desk_.folder->lock().check_there(); };
    film_ = draw ? std::make_unique<FilmMaker>(scene, film, std::move(draw))
                 : std::make_unique<FilmMaker>(scene, film);
    desk_.record.gl = film_->drawer();
    if (film.film && scene.film.format != FilmFormat::png)
        for (auto& library : ffmpeg_versions()) desk_.record.libraries.push_back(std::move(library));
    desk_.listener.detail("drawn with " + desk_.record.gl);
}

void FolderFilm::show(const Taken& picture, const FilmSegment& rule, const Clock& clock) {
    const auto timer = desk_.times.during("waiting for the film");
    film_->take(picture.frame, pace_caption(rule, picture.periods, drive_, rate_, clock, wording_));
    note(*picture.frame);
}

void FolderFilm::write_times() const {
    if (made_) times_.write(desk_.folder->path() / kFilmTimes, result_.frames);
}

void FolderFilm::close() {
    if (!film_) return;
    desk_.failure.attempt([&] {
        const auto timer = desk_.times.during("finishing the film");
        result_ =
            film_->finish([this] { return desk_.listener.in_a_hurry() || !desk_.folder->lock().is_there(); });
        if (!result_.complete) desk_.listener.info("note: the film was left as it is");
        for (const std::string& note : result_.notes) desk_.listener.info("note: " + note);
    });
    result_.frames = film_->frames_done();
    film_.reset();
    made_ = request_.film && !request_.to_stdout;
    desk_.times.add("drawing (beside the engine)", result_.draw_seconds);
    desk_.times.add("encoding (beside the engine)", result_.encode_seconds);
}

void FolderFilm::describe(RunJson& record) const {
    record.raster_threads = wanted() ? threads_.raster : 0;
    record.encoder_threads = wanted() ? threads_.encoder : 0;
    record.film_frames = result_.frames;
    if (film_) record.film_frames.reset();  // how many are on disk is known only when the film is closed
    record.encoder = result_.encoder;
}

void FolderFilm::show_progress() {
    Progress progress;
    progress.stage = Progress::Stage::drawing;
    progress.frames = film_->frames_done();
    progress.frames_planned = frames_planned_;
    progress.done = static_cast<double>(progress.frames) / static_cast<double>(frames_planned_);
    progress.elapsed = desk_.watch.seconds();
    if (progress.frames > 0 && progress.elapsed > 1)
        progress.remaining = progress.elapsed * (1 - progress.done) / progress.done;
    desk_.listener.progress(progress);
}

std::string FolderFilm::files_text() const {
    std::string text;
    if (!result_.file.empty())
        text += fmt::format("{} ({}), ", result_.file, counted(result_.frames, "frame"));
    if (request_.to_stdout) text += fmt::format("to stdout {}, ", counted(result_.frames, "frame"));
    if (result_.poster) text += "poster.png, ";
    if (result_.sheet) text += "sheet.png, ";
    if (result_.pictures) text += fmt::format("frames/ ({}), ", counted(result_.frames, "picture"));
    return text;
}

namespace fs = std::filesystem;

namespace {

constexpr double shown_for = 2;  // s of simulated time for which a caption about a change is shown

// Whether each picture shows a single moment and nothing that a kept moment lacks.
bool is_of_single_moments(const Film& film) {
    const bool spans =
        std::any_of(film.segments.begin(), film.segments.end(),
                    [](const FilmSegment& segment) { return segment.exposure > 0 || segment.average > 0; });
    return !spans && !needs_displacement(film.shows) && !needs_touches(film.shows);
}

// The first step before `end` at which the planned film has another picture than the kept moments; `end` if
// there is none. It is no difference if a picture of a locked segment was not kept.
std::int64_t film_agrees_until(const FilmedScene& scene, const Plan& plan,
                               const std::vector<std::int64_t>& kept, std::int64_t first, std::int64_t end) {
    const std::vector<Instant> instants = instants_of(scene, plan.clock, plan.steps);
    std::size_t k = 0;
    for (const Due& shot : shots_at(instants, scene.film.segments, plan.clock, plan.steps)) {
        if (shot.step >= end) break;
        if (shot.step < first) continue;
        if (k < kept.size() && kept[k] == shot.step) {
            ++k;
            continue;
        }
        const FilmSegment& rule = scene.film.segments.at(static_cast<std::size_t>(shot.segment));
        const bool left_out =
            rule.kind == FilmSegment::Kind::locked && k < kept.size() && kept[k] > shot.step;
        if (!left_out) return k < kept.size() ? std::min(shot.step, kept[k]) : shot.step;
    }
    return k < kept.size() ? std::min(end, kept[k]) : end;
}

// Adds a caption from `time` on, or a line to the caption that begins then. Captions do not overlap: one that
// is shown at that time ends there, and the new one ends at the latest where the next one begins.
void add_caption(FilmedScene& scene, double time, const std::string& text) {
    std::vector<FilmCaption>& captions = scene.film.captions;
    const auto next = std::find_if(captions.begin(), captions.end(),
                                   [&](const FilmCaption& caption) { return caption.from >= time; });
    if (next != captions.end() && next->from == time) {
        next->text += "\n" + text;
        if (!next->words.empty()) next->words.push_back({"\n" + text, "", "", 1});
        return;
    }
    double end = std::min(time + shown_for, scene.run.duration);
    if (next != captions.end()) end = std::min(end, next->from);
    if (next != captions.begin()) (next - 1)->to = std::min((next - 1)->to, time);
    captions.insert(next, {time, end, text, 0, {}});
}

}  // namespace

bool has_film(const FilmedScene& scene, const fs::path& run) {
    const std::string name = film_file_name(scene.film.format);
    return (!name.empty() && (is_there(run / name) || is_there(run / (name + ".part")))) ||
           is_there(run / "movie.work") || is_there(run / "frames") || is_there(run / kFilmMoments);
}

FramesReach reach_of_film(const FilmedScene& scene, const Plan& plan) {
    return [&](const std::vector<std::int64_t>& kept, std::int64_t first, std::int64_t last) {
        return is_of_single_moments(scene.film) ? film_agrees_until(scene, plan, kept, first, last) : first;
    };
}

void add_caption_of_change(FilmedScene& scene, double time, const std::string& text) {
    if (text.empty()) return;
    add_caption(scene, time, text);
    tell_engine(scene);
}

}  // namespace grainreel
