// One run of the verb `movie`, from the accepted scene to the closed files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/run/folder/scene_job.hpp"
#include "render/film/run/folder_film.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/live_shots.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class MovieJob final : public SceneJob {
  public:
    // Throws UserError, before anything is written, when scene, plan or options are wrong.
    MovieJob(const FilmRequest& request, Listener& listener, const FilmedScene& scene, const Plan& plan);
    // Resumes the run in the folder request.out, which is locked, from `point`. Throws UserError or RunError
    // before anything in the folder has changed.
    MovieJob(const FilmRequest& request, Listener& listener, const FilmedScene& scene, const Plan& plan,
             ResumePoint point, std::shared_ptr<FolderLock> lock);

  private:
    MovieJob(const FilmRequest& request, Listener& listener, const FilmedScene& scene, const Plan& plan,
             const ThreadPlan& threads, Pictures pictures);
    MovieJob(const FilmRequest& request, Listener& listener, const FilmedScene& scene, const Plan& plan,
             ResumePoint point, Pictures pictures);

    void start() override;
    bool next(const RunDriver::GoOn& go_on) override;
    std::vector<std::string> news() const override { return source_.news(); }
    std::vector<std::string> more_warnings() const override;
    std::string threads_text() const override;
    void add_progress(Progress& progress) const override;
    std::string side_files_text() const override { return film_.files_text(); }
    std::string side_times_text() const override;
    SideWork* side_work() override { return &film_; }
    void side_work_closed() override;
    void put_back() override;

    void check_film() const;

    const Pictures pictures_;
    FolderFilm film_;
    LiveShots source_;
};

}  // namespace grainreel
