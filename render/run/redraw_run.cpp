#include "render/run/redraw_run.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/team.hpp"
#include "render/film/files/film_limits.hpp"
#include "render/film/sampling/pacing.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/run/stop_signal.hpp"

namespace grainreel {

namespace {

constexpr double hair = 1e-9;  // s

std::vector<std::size_t> choose(const RenderRequest& request, const std::vector<Frame>& moments) {
    const double from = request.from.value_or(moments.front().time) - hair;
    const double to = request.to.value_or(moments.back().time) + hair;
    std::vector<std::size_t> inside;
    for (std::size_t i = 0; i < moments.size(); ++i)
        if (moments[i].time >= from && moments[i].time <= to) inside.push_back(i);
    if (inside.empty())
        throw UserError(fmt::format("{}: no frame of the run lies there; they go from {:.6g} to {:.6g} s",
                                    request.from ? "--from" : "--to", moments.front().time,
                                    moments.back().time));
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < inside.size(); i += static_cast<std::size_t>(request.every))
        chosen.push_back(inside[i]);
    return chosen;
}

// Of frames at one phase of the drive, those that lie whole multiples of `periods` behind the first: the bed
// looks alike there.
std::vector<std::size_t> alike(std::vector<std::size_t> chosen, const std::vector<Frame>& moments,
                               int periods) {
    constexpr double room = 1e-6;  // periods
    const auto after_first = [&](std::size_t i) {
        return moments[i].cycles - moments[chosen.front()].cycles;
    };
    for (const std::size_t i : chosen)
        if (std::abs(after_first(i) - std::round(after_first(i))) > room) return chosen;
    std::vector<std::size_t> kept;
    for (const std::size_t i : chosen)
        if (std::llround(after_first(i)) % periods == 0) kept.push_back(i);
    return kept;
}

std::vector<Frame> moments_at(const std::vector<std::size_t>& chosen, const std::vector<Frame>& all) {
    std::vector<Frame> moments;
    for (const std::size_t i : chosen) moments.push_back(all[i]);
    return moments;
}

// The run's folder is what is drawn from: it is neither replaced nor written to.
void check_out(const FilmRequest& options, const FinishedRun& run) {
    std::error_code error;
    if (options.out && std::filesystem::equivalent(*options.out, run.folder(), error))
        throw UserError(
            fmt::format("--out {}: is the run that is drawn; choose another name", options.out->string()));
    if (!options.film && !options.frames)
        throw UserError("--no-film: leaves nothing to draw; add --frames for the pictures");
}

}  // namespace

ThreadPlan drawing_threads(int wanted) {
    const int processors = wanted > 0 ? wanted : usable_processors();
    const int raster = std::max(1, processors / 2);
    return {0, raster, std::max(1, processors - raster)};
}

RedrawRun::RedrawRun(const FilmRequest& options, const RenderRequest& request, Reporter& reporter,
                     const FinishedRun& run)
    : FilmRun(options, reporter),
      run_(run),
      chosen_(alike(choose(request, run.moments()), run.moments(), run.periods())),
      moments_(moments_at(chosen_, run.moments())),
      scene_(run.scene()) {
    check_out(options, run);
    check_film(scene_, static_cast<std::int64_t>(chosen_.size()));
    threads_ = drawing_threads(scene_.run.threads);
    make_folder({scene_.name + "-render", run.folder().parent_path(), options.out, options.force});
}

bool RedrawRun::work() {
    mark_begun();
    const std::optional<FilmSegment> segment = pacing_of(moments_, scene_.drive, scene_.film.rate);
    std::vector<std::string> warnings = run_.warnings();
    if (run_.periods() > 1 && scene_.film.periods == 0)
        warnings.push_back(
            fmt::format("the bed repeats itself only every {0} periods of the drive: frames at one phase and "
                        "displacements go by {0} periods; film.periods = 1 lets them go by one",
                        run_.periods()));
    if (auto warning = pacing_warning(moments_, scene_.drive)) warnings.push_back(std::move(*warning));
    for (std::string& line : film_warnings(scene_, static_cast<std::int64_t>(chosen_.size())))
        warnings.push_back(std::move(line));
    record_.scene_file = scene_.file;
    record_.drawn = {{run_.folder().string(), static_cast<std::int64_t>(chosen_.size()),
                      moments_.front().time, moments_.back().time}};
    begin_record(warnings);
    std::string caption;
    if (segment) {
        scene_.film.segments = {*segment};
        caption = playback_caption(*segment, scene_.drive, scene_.film.rate);
    }
    pictures_planned_ = static_cast<std::int64_t>(chosen_.size());
    open_film(scene_);
    for (const std::size_t index : chosen_) {
        if (stop_signal() != 0) return false;
        folder_->lock().check_there();
        FramePtr frame;
        {
            const auto timer = times_.during("reading");
            frame = std::make_shared<const Frame>(run_.frame(index));
        }
        const auto timer = times_.during("waiting for the film");
        film_->take(std::move(frame), caption);
        show_progress();
    }
    return true;
}

void RedrawRun::show_progress() {
    Progress progress;
    progress.stage = Progress::Stage::drawing;
    progress.frames = film_->frames_done();
    progress.frames_planned = pictures_planned_;
    progress.done = static_cast<double>(progress.frames) / static_cast<double>(pictures_planned_);
    progress.elapsed = watch_.seconds();
    if (progress.frames > 0 && progress.elapsed > 1)
        progress.remaining = progress.elapsed * (1 - progress.done) / progress.done;
    reporter_.progress(progress);
}

std::string RedrawRun::stopped_text() const {
    return fmt::format("stopped at frame {} of {}", film_report_.frames, pictures_planned_);
}

void RedrawRun::report_written() {
    reporter_.info(fmt::format("wrote {}: {}run.json, log.txt", folder_->path().string(), film_files_text()));
    reporter_.info(fmt::format("took {}: {} frames of {}, from {:.6g} to {:.6g} s",
                               duration_text(watch_.seconds()), film_report_.frames, run_.folder().string(),
                               moments_.front().time, moments_.back().time));
}

}  // namespace grainreel
