// One run of the verb `movie`, from the accepted scene to the closed files.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "render/film/production/caption_holds.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/run/film_run.hpp"
#include "render/run/film_times_table.hpp"
#include "render/run/scene_run.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class MovieRun final : public FilmRun {
  public:
    // Throws UserError for what scene, plan or options get wrong; nothing is on disk then.
    MovieRun(const FilmRequest& request, RunListener& listener, const FilmedScene& scene, const Plan& plan);
    // The run in the folder request.out, which is locked, goes on from that point. Throws UserError or
    // RunError; nothing in the folder has changed then.
    MovieRun(const FilmRequest& request, RunListener& listener, const FilmedScene& scene, const Plan& plan,
             ResumePoint point, std::shared_ptr<FolderLock> lock);

  private:
    bool work() override;
    void keep_state() override;
    void conclude() override;
    void film_closed(std::int64_t frames) override;
    bool is_behind_former() const override { return run_.is_behind_former(); }
    void put_back() override { run_.put_back(); }
    std::string stopped_text() const override;
    void report_written() override;

    void describe();
    bool pack();  // false when the run was asked to stop
    void take(const Taken& picture);
    void tell_news();
    void show_progress();
    void report_segregation();

    Pictures pictures_;
    SceneRun run_;
    std::optional<Stopwatch> vibrating_;
    std::optional<CaptionHolds> holds_;  // for film_times_
    FilmTimesTable film_times_;
    std::size_t told_ = 0;  // lines of the run's news
};

}  // namespace grainreel
