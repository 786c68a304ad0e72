// A scene that another engine runs on this machine: it is handed over, its dump is followed while it grows,
// and the folder is that of any run, with its film.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/handover/bring_back.hpp"
#include "engine/handover/carried_scene.hpp"
#include "engine/handover/engine_job.hpp"
#include "render/film/run/folder_film.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Steps of all pictures of a run from step 0 on, with those that they are exposed over or averaged over; by
// rising step.
std::vector<std::int64_t> needed_steps(const FilmedScene& scene, const Clock& clock, std::int64_t steps);

// carried.dumps also has the steps of the film's pictures; those of the trajectory are left out where both
// together would end the engine's run too often.
void want_pictures(CarriedScene& carried, const FilmedScene& scene);

class EngineRun final : public FilmRun {
  public:
    // scene: as it was read; it is run with the laws of `carried`. Throws UserError; nothing is on disk then.
    EngineRun(const FilmRequest& request, RunListener& listener, const FilmedScene& scene,
              CarriedScene carried);
    // Goes on in the folder of such a run from the engine's last restart file: the dump is read again from
    // its begin. scene, plan: of the folder's scene.toml. Throws UserError where there is nothing to go on
    // from.
    EngineRun(const FilmRequest& request, RunListener& listener, const FilmedScene& scene, const Plan& plan,
              std::shared_ptr<FolderLock> lock);

  private:
    bool work() override;
    void conclude() override;
    void side_work_closed() override;
    std::string stopped_text() const override;
    void report_written() override;

    std::int64_t pictures() const;
    std::vector<std::string> warnings() const;
    bool hand_over();
    void take_up();
    std::filesystem::path place() const { return folder() / ReturnedRun::kFolder; }
    void follow();
    bool read_dump();
    void show_progress();
    bool draw();

    std::optional<std::int64_t> restart_;  // the engine's step of the file that it goes on from
    CarriedScene carried_;
    FilmedScene scene_;
    EngineJob job_;
    std::unique_ptr<ReturnedRun> back_;
    Stopwatch running_;
    FilmTimesTable film_times_;
};

}  // namespace grainreel
