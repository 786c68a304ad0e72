#include "render/film/run/folder_film.hpp"

#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/film/sampling/film_limits.hpp"
#include "render/film/sampling/held_frames.hpp"

namespace grainreel {

void FolderFilm::check(const FilmedScene& scene, std::int64_t frames) const {
    if (request_.to_stdout && !(request_.film && scene.film.format == FilmFormat::y4m))
        throw UserError("--out -: stdout takes a film in y4m alone; add --format y4m, or name a folder");
    if (request_.film) check_max_size(scene, frames);
}

void FolderFilm::open(const FilmedScene& scene, std::int64_t pictures, FramePtr start, DrawerMaker draw) {
    if (!wanted()) return;
    desk_.folder->lock().check_there();  // else the film would begin in whatever has its name now
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
    frames_planned_ = frames_here_.value_or(pictures + held_frames(scene.film));
    film.check_folder = [this] { desk_.folder->lock().check_there(); };
    film_ = draw ? std::make_unique<FilmMaker>(scene, film, std::move(draw))
                 : std::make_unique<FilmMaker>(scene, film);
    desk_.record.gl = film_->drawer();
    desk_.listener.detail("drawn with " + desk_.record.gl);
}

void FolderFilm::close() {
    if (!film_) return;
    desk_.failure.attempt([&] {
        const auto timer = desk_.times.during("finishing the film");
        report_ =
            film_->finish([this] { return desk_.listener.in_a_hurry() || !desk_.folder->lock().is_there(); });
        if (!report_.complete) desk_.listener.info("note: the film was left as it is");
        for (const std::string& note : report_.notes) desk_.listener.info("note: " + note);
    });
    report_.frames = film_->frames_done();
    film_.reset();
    made_ = request_.film && !request_.to_stdout;
    desk_.times.add("drawing (beside the engine)", report_.draw_seconds);
    desk_.times.add("encoding (beside the engine)", report_.encode_seconds);
}

void FolderFilm::describe(RunRecord& record) const {
    record.raster_threads = wanted() ? threads_.raster : 0;
    record.encoder_threads = wanted() ? threads_.encoder : 0;
    record.film_frames = report_.frames;
    if (film_) record.film_frames.reset();  // what of it is on disk shows when it is closed
    record.encoder = report_.encoder;
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
    if (!report_.file.empty()) text += fmt::format("{} ({} frames), ", report_.file, report_.frames);
    if (request_.to_stdout) text += fmt::format("to stdout {} frames, ", report_.frames);
    if (report_.poster) text += "poster.png, ";
    if (report_.sheet) text += "sheet.png, ";
    if (report_.pictures) text += fmt::format("frames/ ({} pictures), ", report_.frames);
    return text;
}

}  // namespace grainreel
