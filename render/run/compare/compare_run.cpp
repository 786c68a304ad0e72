#include "render/run/compare/compare_run.hpp"

#include <algorithm>
#include <atomic>

#include <fmt/format.h>

#include "render/draw/camera/camera_path.hpp"
#include "render/film/production/side_by_side_drawer.hpp"
#include "render/run/compare/comparison_words.hpp"
#include "render/run/stop_signal.hpp"
#include "render/run/together.hpp"

namespace grainreel {

namespace {

bool go_on() {
    return stop_signal() == 0;
}

}  // namespace

CompareRun::CompareRun(const FilmRequest& options, Reporter& reporter, Comparison all)
    : FilmRun(options, reporter), all_(std::move(all)) {
    threads_ = all_.threads;
    make_folder({all_.film.name, options.base, options.out, options.force});
}

void CompareRun::begin() {
    for (const auto& source : all_.sources) {
        record_.panels.push_back(source->place());
        if (dynamic_cast<const RecordedPanel*>(source.get()) != nullptr)
            record_.drawn.push_back({source->place(), static_cast<std::int64_t>(all_.instants.size()),
                                     all_.instants.front().time, all_.instants.back().time});
    }
    begin_record(all_.warnings);
    for (const auto& source : all_.sources) source->begin(folder_->path(), options_.command);
}

bool CompareRun::work() {
    begin();
    Frames frames(all_.sources.size());
    if (!for_all(Progress::Stage::growing, frames,
                 [](ComparePanel& panel, FramePtr&) { return panel.pack(go_on); }))
        return false;
    mark_begun();
    const std::vector<FilmSegment>& segments = all_.film.film.segments;
    for (const auto& source : all_.sources) source->start(all_.instants, segments);
    pictures_planned_ = static_cast<std::int64_t>(all_.instants.size());
    for (Panel& panel : all_.panels)
        settle_orbit(panel.scene.film.camera, static_cast<double>(pictures_planned_) / all_.film.film.rate);
    std::vector<std::size_t> segment_of;
    for (const Instant& instant : all_.instants)
        segment_of.push_back(static_cast<std::size_t>(instant.segment));
    open_film(all_.film, side_by_side_drawer(all_.panels, all_.film.film, threads_.raster, options_.gl,
                                             all_.reference, segment_of));
    stage_ = Stopwatch();
    for (const std::size_t segment : segment_of) {
        const auto next = [](ComparePanel& panel, FramePtr& frame) {
            frame = panel.next(go_on);
            return frame != nullptr;
        };
        if (!for_all(Progress::Stage::vibrating, frames, next)) return false;
        const auto timer = times_.during("waiting for the film");
        film_->take(frames, playback_of_all(all_.panels, segment));
    }
    return for_all(Progress::Stage::vibrating, frames,
                   [](ComparePanel& panel, FramePtr&) { return panel.finish(go_on); });
}

bool CompareRun::for_all(Progress::Stage stage, Frames& frames, const Work& work) {
    const auto timer = times_.during(stage == Progress::Stage::growing ? "packing" : "engine");
    std::atomic<bool> all_well = true;
    std::vector<std::function<void()>> works;
    for (std::size_t i = 0; i < all_.sources.size(); ++i)
        works.push_back([&, i] {
            try {
                if (!work(*all_.sources[i], frames[i])) all_well = false;
            } catch (const std::exception& problem) {
                all_.sources[i]->note_failure(problem.what());
                throw;
            }
        });
    run_together(works, [&] { show_progress(stage); });
    show_progress(stage);
    return all_well;
}

void CompareRun::show_progress(Progress::Stage stage) {
    Progress progress;
    progress.stage = stage;
    for (const auto& source : all_.sources) {
        progress.done += source->done() / static_cast<double>(all_.sources.size());
        progress.particle_steps_per_second += source->speed();
    }
    progress.end = all_.instants.back().time;
    progress.time = progress.done * progress.end;
    progress.frames = film_ ? film_->frames_done() : 0;
    progress.frames_planned = pictures_planned_;
    progress.elapsed = watch_.seconds();
    const double seconds = stage_.seconds();
    if (stage == Progress::Stage::vibrating && progress.done > 0 && seconds > 1)
        progress.remaining = seconds * (1 - progress.done) / progress.done;
    reporter_.progress(progress);
}

void CompareRun::keep_state() {
    for (const auto& source : all_.sources) source->keep_state();
}

void CompareRun::conclude() {
    for (const auto& source : all_.sources) source->close(record_.status, *record_.exit_status, failure_);
}

std::string CompareRun::stopped_text() const {
    return fmt::format("stopped at frame {} of {}", film_report_.frames, pictures_planned_);
}

void CompareRun::report_written() {
    for (const auto& source : all_.sources)
        for (const std::string& line : source->news())
            reporter_.warning(fmt::format("{}: {}", source->place(), line));
    std::vector<std::string> folders;
    for (const auto& source : all_.sources)
        if (dynamic_cast<const LivePanel*>(source.get()) != nullptr) folders.push_back(source->place() + "/");
    const std::string runs =
        folders.empty() ? "" : fmt::format("{} (each a run), ", fmt::join(folders, ", "));
    reporter_.info(
        fmt::format("wrote {}: {}{}run.json, log.txt", folder_->path().string(), film_files_text(), runs));
    reporter_.info(fmt::format("took {}: {} panels, from {:.6g} to {:.6g} s", duration_text(watch_.seconds()),
                               all_.sources.size(), all_.instants.front().time, all_.instants.back().time));
}

}  // namespace grainreel
