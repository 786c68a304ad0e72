// Runs a scene with another engine on this machine: the scene is handed over, and the engine's dump is read
// while it grows. The result is an ordinary run's folder with its film.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/handover/bring_back.hpp"
#include "engine/handover/carried_scene.hpp"
#include "engine/handover/peer_process.hpp"
#include "render/film/run/folder_film.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// All steps that the pictures of a run from step 0 on need, rising and each once: the step of each picture,
// and the steps over which it is exposed or averaged.
std::vector<std::int64_t> needed_steps(const FilmedScene& scene, const Clock& clock, std::int64_t steps);

// Adds the steps of the film's pictures to carried.dumps, the steps at which the engine writes a frame.
// Before the call these are the steps of the trajectory. They are dropped if both together would interrupt
// the engine's run too often.
void want_pictures(CarriedScene& carried, const FilmedScene& scene);

class PeerJob final : public FilmJob {
  public:
    // scene: the scene as it was read. Its film is kept, and everything else is taken from `carried`, which
    // has the engine's laws. Throws UserError before anything is written.
    PeerJob(const FilmRequest& request, Listener& listener, const FilmedScene& scene, CarriedScene carried);
    // Continues such a run in its folder, from the engine's last restart file. The dump is read again from
    // its beginning. scene, plan: those of the folder's scene.toml. Throws UserError when there is no restart
    // file, or when the run has come to its end.
    PeerJob(const FilmRequest& request, Listener& listener, const FilmedScene& scene, const Plan& plan,
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

    // Step of the restart file from which the engine goes on, as the engine counts; empty for a new run.
    std::optional<std::int64_t> restart_;
    CarriedScene carried_;
    FilmedScene scene_;
    PeerProcess job_;
    std::unique_ptr<ReturnedRun> back_;
    std::string unsound_;  // what is wrong with the dump, so that no more of it is read; empty: nothing
    Stopwatch running_;
};

}  // namespace grainreel
