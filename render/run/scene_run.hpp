// One scene being run: packing, vibration up to the moments that somebody wants to see, and the files it
// leaves in its folder. Knows no film; `movie` has one of these, `compare` several.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/output/folder_lock.hpp"
#include "engine/output/run_json.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/simulation.hpp"
#include "engine/scene/scene.hpp"
#include "render/cli/report/pace.hpp"
#include "render/run/checkpoint_pace.hpp"
#include "render/run/first_failure.hpp"
#include "render/run/moments/agenda.hpp"
#include "render/run/moments/bed_periods.hpp"
#include "render/run/moments/earlier_positions.hpp"
#include "render/run/moments/exposed_moments.hpp"
#include "render/run/moments/period_means.hpp"
#include "render/run/run_files.hpp"
#include "render/run/stage_times.hpp"

namespace grainreel {

class SceneRun {
  public:
    // Asked every tenth of a second or so; false: stop.
    using GoOn = std::function<bool()>;
    struct Taken {
        FramePtr frame;
        std::vector<int> segments;  // of the film, one a picture
        int periods;                // after which the bed repeats itself, as the film has it
    };

    // Throws UserError for what scene or plan get wrong; nothing is on disk then.
    SceneRun(const Scene& scene, const Plan& plan, int threads);

    // Writes scene.toml there; the other files follow with start(). The lock outlives the run; from here
    // pack() and next() throw RunError soon after the folder is gone.
    void use_folder(const FolderLock& folder);
    // False when the watcher stopped it.
    bool pack(const PackingWatcher& watcher);
    const PackingResult& packing() const { return packing_; }
    // After packing: opens the files. shots: what next() is to stop for; segments: of the film that they
    // make. may_leave_out: locked ones that a bed lacks which repeats itself only every so many periods.
    void start(std::vector<Shot> shots, const std::vector<FilmSegment>& segments, bool may_leave_out = true);
    // What was found of the bed's periods so far, a line each.
    std::vector<std::string> news() const;
    // To the next shot, keeping on the way what is to be kept. None at the end, or when told to stop.
    std::optional<Taken> next(const GoOn& go_on);
    // Of a run that was packed, in whatever state: last row of measures, end state, checkpoint. Nothing when
    // its folder is gone.
    void close(FirstFailure& failure);

    const Scene& scene() const { return scene_; }
    const Plan& plan() const { return plan_; }
    const Simulation& simulation() const { return simulation_; }
    const StageTimes& times() const { return times_; }
    const std::optional<RunFiles>& files() const { return files_; }
    bool packed() const { return packed_; }
    std::int64_t shots() const { return shots_; }
    double done() const;                                   // share of the vibration
    double recent_speed() const { return rate_.value(); }  // particle-steps/s
    double speed() const;                                  // particle-steps/s, time in the engine alone
    std::string packing_text() const;
    std::optional<std::string> packing_warning() const;
    // "trajectory.nc (4 frames), measures.csv (30 rows), ..."
    std::string files_text() const;
    // What is known when the run begins, and when it has ended.
    void describe(RunRecord& record) const;
    void conclude(RunRecord& record) const;

  private:
    bool advance_to(std::int64_t target, const GoOn& go_on);
    void leave_out_pictures(Stop& stop);
    FramePtr serve(const Stop& stop);
    void add_measures();
    void add_what_the_film_needs(Frame& frame);
    void save_checkpoint();
    std::filesystem::path path_of(const char* file) const { return folder_->folder() / file; }

    Scene scene_;
    Plan plan_;
    Simulation simulation_;
    const FolderLock* folder_ = nullptr;
    PackingResult packing_;
    bool packed_ = false;
    std::int64_t first_step_ = 0, shots_ = 0;
    std::optional<RunFiles> files_;
    std::optional<Agenda> agenda_;
    std::optional<BedPeriods> bed_periods_;
    std::vector<FilmSegment> segments_;  // of the film
    EarlierPositions earlier_;
    ExposedMoments exposed_;
    PeriodMeans means_;
    StageTimes times_;
    Pace pace_;
    CheckpointPace checkpoints_;
    double particle_steps_ = 0;                // of vibration
    RecentRate rate_;                          // particle-steps/s
    std::optional<std::uint64_t> state_hash_;  // of the end state
};

}  // namespace grainreel
