// One scene that is run in a folder, from the accepted scene to the closed files. Complete as it is; who
// makes a film of the run derives from it.
//
//     const Scene scene = read_scene("scene.toml", {}, measurable_in);
//     SceneFolderRun run({.out = "output/mine"}, listener, scene, make_plan(scene));
//     const FolderRun::Ended ended = run.run();
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/measure/measures.hpp"
#include "engine/run/driver/run_driver.hpp"
#include "engine/run/folder/folder_run.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class SceneFolderRun : public FolderRun {
  public:
    // With as many threads as the scene says, or as are of use. Throws UserError for what scene, plan or
    // request get wrong; nothing is on disk then. The listener must outlive the run.
    SceneFolderRun(const RunRequest& request, RunListener& listener, const Scene& scene, const Plan& plan);
    // The run in the folder request.out, which is locked, goes on from that point. A film's wishes are those
    // of before, in scene.wishes. Throws UserError or
    // RunError; nothing in the folder has changed then.
    SceneFolderRun(const RunRequest& request, RunListener& listener, const Scene& scene, const Plan& plan,
                   ResumePoint point, std::shared_ptr<FolderLock> lock);

    // Its grains and all else: as it starts, and after run() as it ended.
    const Simulation& simulation() const { return driver_.simulation(); }

  protected:
    // For who derives: without a folder yet, which new_folder() or go_on_in() takes.
    SceneFolderRun(const RunRequest& request, RunListener& listener, const Scene& scene, const Plan& plan,
                   int threads);
    SceneFolderRun(const RunRequest& request, RunListener& listener, const Scene& scene, const Plan& plan,
                   ResumePoint point);
    void new_folder();
    // hands_out: as in RunDriver::keep_former().
    void go_on_in(std::shared_ptr<FolderLock> lock, bool hands_out);

    // What is wanted of the run on its way. By default nothing.
    virtual void start() { driver_.start({}); }
    // Goes to the next frame that is wanted and takes it; false after the last, and when told to stop.
    virtual bool next(const RunDriver::GoOn& go_on) { return driver_.next(go_on) != nullptr; }
    // A line each; more may come at the end while the run goes on.
    virtual std::vector<std::string> news() const { return driver_.news(); }
    // Beside those of the plan.
    virtual std::vector<std::string> more_warnings() const { return {}; }
    virtual std::string threads_text() const;
    virtual void add_progress(Progress& /*progress*/) const {}
    virtual std::string side_files_text() const { return ""; }  // "movie.mp4 (4 frames), "
    virtual std::string side_times_text() const { return ""; }  // ", film 0.1 s"

    bool work() override;
    void keep_state() override { driver_.close(desk_.failure); }
    // Writes the other formats that the scene asks for.
    void side_work_closed() override;
    void conclude() override;
    bool is_behind_former() const override { return driver_.is_behind_former(); }
    void put_back() override { driver_.put_back(); }
    std::string stopped_text() const override;
    void report_written() override;

    RunDriver driver_;

  private:
    void describe();
    bool pack();  // false when the run was asked to stop
    void tell_news();
    void show_progress();
    void report_segregation();

    std::optional<Stopwatch> vibrating_;
    std::size_t told_ = 0;  // lines of news
};

// How far a run has separated its species, in one line: what a scene with two species or more did, in words.
// to: means over the rows that `over` names. Indices that are not defined at the start and then are left out;
// empty where none is. Where the two that are 1 in a mixture disagree, it says so.
std::string segregation_text(const Scene& scene, const Measures& from, const Measures& to,
                             const std::string& over);

}  // namespace grainreel
