// Runs one scene in a folder, from the accepted scene to the closed files. The class can be used as it is;
// code that makes a film of the run derives from it.
//
//     const Scene scene = read_scene("scene.toml", {}, measurable_in);
//     SceneJob run({.out = "output/mine"}, listener, scene, make_plan(scene));
//     const FolderJob::Ended ended = run.run();
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/measure/measures.hpp"
#include "engine/run/driver/run_driver.hpp"
#include "engine/run/folder/folder_job.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class SceneJob : public FolderJob {
  public:
    // A new run, with as many threads as the scene says, or as are useful. Throws UserError for mistakes in
    // scene, plan or request. Nothing is on disk then. The listener must outlive the run.
    SceneJob(const JobRequest& request, Listener& listener, const Scene& scene, const Plan& plan);
    // A run that goes on from `point` in the folder request.out, which is locked. scene.wishes must hold what
    // a film wanted of the run before. Throws UserError or RunError; nothing in the folder has changed then.
    SceneJob(const JobRequest& request, Listener& listener, const Scene& scene, const Plan& plan,
             ResumePoint point, std::shared_ptr<FolderLock> lock);

    // The simulation, as it starts, and after run() as it ended.
    const SimulatedBed& simulation() const { return driver_.simulation(); }

  protected:
    // For derived classes: a run without a folder, which new_folder() or go_on_in() sets.
    SceneJob(const JobRequest& request, Listener& listener, const Scene& scene, const Plan& plan,
             int threads);
    SceneJob(const JobRequest& request, Listener& listener, const Scene& scene, const Plan& plan,
             ResumePoint point);
    void new_folder();
    // `hands_out` is as in RunDriver::keep_former().
    void go_on_in(std::shared_ptr<FolderLock> lock, bool hands_out);

    // Starts the driver with the FilmWishes of a derived class. By default there are none.
    virtual void start() { driver_.start({}); }
    // Goes to the next wanted frame and takes it. Returns false after the last frame, and if told to stop.
    virtual bool next(const RunDriver::GoOn& go_on) { return driver_.next(go_on) != nullptr; }
    // News, a line each. Lines may be appended while the run goes on.
    virtual std::vector<std::string> news() const { return driver_.news(); }
    // Warnings besides those of the plan.
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
    bool pack();  // false when the run was asked to stop before its grains were packed
    void tell_news();
    void warn(const std::string& line);
    void show_progress();
    void report_segregation();

    std::optional<Stopwatch> vibrating_;
    std::size_t told_ = 0;  // number of lines of news that were shown
};

// One line about how far a run with two or more species has separated them. `to` holds means over the rows
// that `over` names. Indices that are not defined both at the start and at the end are left out; the text is
// empty if none is left. If the two indices that are 1 in a mixture disagree, the line says so.
std::string segregation_text(const Scene& scene, const Measures& from, const Measures& to,
                             const std::string& over);

}  // namespace grainreel
