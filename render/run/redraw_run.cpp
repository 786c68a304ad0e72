#include "render/run/redraw_run.hpp"

#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/film/files/film_limits.hpp"
#include "render/film/sampling/pacing.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/run/frames/choice.hpp"

namespace grainreel {

namespace {

// The run's folder is what is drawn from: it is neither replaced nor written to.
void check_out(const FilmRequest& request, const FrameArchive& run) {
    std::error_code error;
    if (request.out && std::filesystem::equivalent(*request.out, run.folder(), error))
        throw UserError(
            fmt::format("--out {}: is the run that is drawn; choose another name", request.out->string()));
    if (!request.film && !request.frames)
        throw UserError("--no-film: leaves nothing to draw; add --frames for the pictures");
}

}  // namespace

RedrawRun::RedrawRun(const FilmRequest& request, const RenderRequest& what, RunListener& listener,
                     FrameSource& source)
    : FilmRun(request, listener),
      source_(source),
      archive_(*source.archive()),
      moments_(chosen_moments(what, archive_)),
      scene_(source.scene()) {
    check_out(request, archive_);
    check_film(scene_, static_cast<std::int64_t>(moments_.size()));
    threads_ = drawing_threads(scene_.run.threads);
    make_folder({scene_.name + "-render", archive_.folder().parent_path(), request.out, request.force});
}

std::vector<std::string> RedrawRun::warnings() const {
    std::vector<std::string> warnings = source_.news();
    if (auto warning = periods_warning(scene_, archive_)) warnings.push_back(std::move(*warning));
    if (auto warning = pacing_warning(moments_, scene_.drive)) warnings.push_back(std::move(*warning));
    for (std::string& line : film_warnings(scene_, static_cast<std::int64_t>(moments_.size())))
        warnings.push_back(std::move(line));
    return warnings;
}

bool RedrawRun::work() {
    mark_begun();
    record_.scene_file = scene_.file;
    record_.drawn = {{archive_.folder().string(), static_cast<std::int64_t>(moments_.size()),
                      moments_.front().time, moments_.back().time}};
    begin_record(warnings());
    const std::optional<FilmSegment> segment = pacing_of(moments_, scene_.drive, scene_.film.rate);
    std::string caption;
    if (segment) {
        scene_.film.segments = {*segment};
        caption = playback_caption(*segment, scene_.drive, scene_.film.rate);
    }
    pictures_planned_ = static_cast<std::int64_t>(moments_.size());
    open_film(scene_);
    Pictures pictures;
    for (const Frame& moment : moments_) pictures.instants.push_back({moment.time, 0});
    pictures.segments = {segment.value_or(FilmSegment())};
    source_.start(pictures);
    const auto go_on = [this] {
        if (listener_.stop_signal() != 0) return false;
        folder_->lock().check_there();
        return true;
    };
    const auto next = [&] {
        const auto timer = times_.during("reading");
        return source_.next(go_on);
    };
    while (std::optional<Taken> picture = next()) {
        const auto timer = times_.during("waiting for the film");
        film_->take(std::move(picture->frame), caption);
        show_drawing();
    }
    return listener_.stop_signal() == 0;
}

std::string RedrawRun::stopped_text() const {
    return fmt::format("stopped at frame {} of {}", film_report_.frames, frames_planned_);
}

void RedrawRun::report_written() {
    listener_.info(fmt::format("wrote {}: {}run.json, log.txt", folder_->path().string(), film_files_text()));
    listener_.info(fmt::format("took {}: {} frames of {}, from {:.6g} to {:.6g} s",
                               duration_text(watch_.seconds()), film_report_.frames,
                               archive_.folder().string(), moments_.front().time, moments_.back().time));
}

}  // namespace grainreel
