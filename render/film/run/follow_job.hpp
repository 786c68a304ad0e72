// Makes the film of a scene that was handed over while its job still runs: each picture is drawn once the
// dump has its moment. The film ends with the job, when nothing new has come for a while, or with Ctrl-C.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/handover/bring_back.hpp"
#include "engine/handover/peer_process.hpp"
#include "engine/plan/plan.hpp"
#include "render/film/run/folder_film.hpp"
#include "render/film/run/follow_run.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sources/stored_shots.hpp"

namespace grainreel {

class FollowJob final : public FilmJob {
  public:
    // what.from: folder of the hand-over. Waits for the first moment, as long as `idle` allows. Throws
    // UserError, before anything is written, when none comes and when files or options are wrong.
    FollowJob(const FilmRequest& request, const FollowRequest& what, Listener& listener);
    const FilmedScene& scene() const { return scene_; }

  private:
    // Why no more moments come.
    enum class End { none, whole, job, idle, unsound };

    bool work() override;
    void side_work_closed() override;
    std::string stopped_text() const override;
    void report_written() override;

    void wait_for_first();
    // How the job is. A status that was there when the film began is of an earlier job, which may go on.
    JobEnd look_at_job();
    // Whether an error in reading came from a job that goes on and cuts the dump; then it is read anew.
    bool job_goes_on();
    // Takes what the dump has, for a quarter of a second at most. Returns whether there was something.
    bool read_some();
    End end_now();
    bool stopped() const { return desk_.listener.stop_signal() != 0; }
    std::vector<std::string> warnings() const;
    void open_anew();
    // Draws all pictures whose moments have come. False when told to stop.
    bool draw_new();
    void draw(const Taken& picture);
    void finish(End end);

    const FollowRequest what_;
    const HandoverFacts facts_;
    FilmedScene scene_;
    const Plan plan_;
    std::unique_ptr<ReturningFolder> returning_;
    std::unique_ptr<ReturnedRun> back_;
    std::string job_;       // name of the job whose moments come
    bool earlier_ = false;  // whether the status is still that of the job before the film began
    Stopwatch idle_;        // since the last moment came
    std::string unsound_;   // why no more moments may be taken
    std::unique_ptr<StoredShots> source_;
    std::int64_t opened_at_ = 0;  // number of moments that source_ knows
    Stopwatch since_opened_;
    double opening_ = 0;       // s that it took to open it
    std::int64_t shown_ = -1;  // step of the last picture
};

}  // namespace grainreel
