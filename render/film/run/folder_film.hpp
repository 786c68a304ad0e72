// The film that a run makes in its folder, with the files beside it: poster, contact sheet, pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "engine/plan/plan.hpp"
#include "engine/run/folder/folder_job.hpp"
#include "engine/run/folder/listener.hpp"
#include "engine/run/resume/resume_point.hpp"
#include "engine/state/state.hpp"
#include "render/film/production/film_maker.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/film/sources/shot_source.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class FolderFilm final : public SideWork {
  public:
    // The desk must outlive the film.
    FolderFilm(FilmRequest request, JobDesk& desk) : request_(std::move(request)), desk_(desk) {}

    const FilmRequest& request() const { return request_; }
    // Whether any pictures are asked for.
    bool wanted() const { return request_.film || request_.frames; }
    // Checks what scene and options ask of the film's file. Throws UserError; RunError without FFmpeg.
    void check(const FilmedScene& scene, std::int64_t frames) const;
    void use_threads(const ThreadPlan& threads) { threads_ = threads; }
    const ThreadPlan& threads() const { return threads_; }

    // To be called before open() for a film in parts. frames: number of frames that are made here.
    void use_extent(FilmExtent extent, std::int64_t frames) {
        extent_ = std::move(extent);
        frames_here_ = frames;
    }
    // Makes the folder of numbered pictures if they are wanted. `resume` sees by this folder that they are
    // wanted, so a run makes it before its first checkpoint.
    void make_frames_place(const FilmedScene& scene) const;
    // Opens the film; does nothing where no pictures are wanted. pictures: number of the whole film's
    // pictures. start: frame from which start heights are counted; null: the film's first picture. draw:
    // makes the drawer; empty for the Renderer.
    void open(const FilmedScene& scene, std::int64_t pictures, StatePtr start = nullptr,
              DrawerMaker draw = {});
    // The film maker, which takes pictures while the film is open.
    FilmMaker& maker() { return *film_; }
    // Corrects the number of the film's frames, for a film of which not all is known when it is opened.
    void plan_frames(std::int64_t frames) { frames_planned_ = frames; }
    // Gives the film its next picture, with a caption about how fast it plays, and notes it for
    // film_times.csv. rule: the segment by which it was taken.
    void show(const Taken& picture, const FilmSegment& rule, const Clock& clock);
    // Notes for film_times.csv the moment of a picture that the caller gives to maker().
    void note(const State& shown) { times_.add(shown, 1 + holds_->begin_at(shown.time)); }
    // Writes film_times.csv, if there is a film in the folder. To be called once the film is closed.
    void write_times() const;
    // Shows the progress of a run that only draws.
    void show_progress();

    std::int64_t frames_done() const { return film_ ? film_->frames_done() : 0; }
    std::int64_t frames_planned() const { return frames_planned_; }
    bool made() const { return made_; }  // whether a film lies in the folder and is closed
    const FilmResult& result() const { return result_; }
    std::string files_text() const;  // "movie.mp4 (4 frames), poster.png, "

    bool is_open() const override { return film_ != nullptr; }
    const char* name() const override { return "the film"; }
    void close() override;
    void drop() override { film_.reset(); }
    void describe(RunJson& record) const override;

  private:
    const FilmRequest request_;
    JobDesk& desk_;
    ThreadPlan threads_;
    std::unique_ptr<FilmMaker> film_;
    std::int64_t frames_planned_ = 0;  // frames of the film, with those that are held for captions
    FilmExtent extent_;
    std::optional<std::int64_t> frames_here_;
    Drive drive_;  // of the scene that is shown
    double rate_ = 0;
    Wording wording_;
    std::optional<CaptionHolds> holds_;
    FilmTimesTable times_;
    FilmResult result_;
    bool made_ = false;
};

// A run that fills a folder with a film whose frames it does not compute itself.
class FilmJob : public FolderJob {
  protected:
    FilmJob(const FilmRequest& request, Listener& listener)
        : FolderJob(request, listener), film_(request, desk_) {}

    SideWork* side_work() override { return &film_; }

    FolderFilm film_;
};

// Whether the run's folder has a film or the beginning of one.
bool has_film(const FilmedScene& scene, const std::filesystem::path& run);

// Finds the last step from which a run with a film can be resumed. The film is drawn again: up to the
// checkpoint from the kept moments of its pictures, and after that as the run goes on. A run starts from its
// beginning if its moments were not kept, or if a picture shows more than one moment. The scene and the plan
// must outlive the result.
FramesReach reach_of_film(const FilmedScene& scene, const Plan& plan);

// Adds a caption about a change of the scene, from `time` (s of simulated time) on, and calls tell_engine().
// Does nothing without a text.
void add_caption_of_change(FilmedScene& scene, double time, const std::string& text);

}  // namespace grainreel
