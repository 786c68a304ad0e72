// One scene being run: packing, vibration up to the moments that somebody wants to see, and the files it
// leaves in its folder. Draws nothing; `movie` has one of these, `compare` several.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/folder_lock.hpp"
#include "engine/files/run_json.hpp"
#include "engine/plan/plan.hpp"
#include "engine/replay/checkpoint_ring.hpp"
#include "engine/run/simulation.hpp"
#include "render/run/checkpoint_pace.hpp"
#include "render/run/first_failure.hpp"
#include "render/run/frames/frame_source.hpp"
#include "render/run/frames/kept_moments.hpp"
#include "render/run/frames/picture_parts.hpp"
#include "render/run/moments/agenda.hpp"
#include "render/run/moments/bed_periods.hpp"
#include "render/run/pace.hpp"
#include "render/run/resume/earlier_pictures.hpp"
#include "render/run/resume/ready_files.hpp"
#include "render/run/resume/resume_point.hpp"
#include "render/run/run_files.hpp"
#include "render/run/stage_times.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class SceneRun final : public FrameSource {
  public:
    // Throws UserError for what scene or plan get wrong; nothing is on disk then.
    SceneRun(const FilmedScene& scene, const Plan& plan, int threads);
    // A run that goes on in its folder. It is packed.
    SceneRun(const FilmedScene& scene, const Plan& plan, ResumePoint point);

    // Writes scene.toml there; the other files follow with start(). The lock outlives the run; from here
    // pack() and next() throw RunError soon after the folder is gone.
    void use_folder(const FolderLock& folder, const std::string& program_version);
    // Of a run that goes on, before use_folder(): looks at all its files, and keeps what it was until it has
    // gone past its former end. pictures: of the film, where it has one. Throws UserError or RunError;
    // nothing in the folder has changed then.
    void keep_former(const FolderLock& folder, const Pictures& pictures, const std::string& program_version);
    // Whether it goes on and has not come to where it was.
    bool is_behind_former() const { return former_kept_; }
    // Closes its files, and the folder is as it was. Nothing else may be called afterwards.
    void put_back();
    // False when the watcher stopped it.
    bool pack(const PackingWatcher& watcher);
    const PackingResult& packing() const { return packing_; }
    // Before start(): key moments are kept with their contacts. A run that goes on does what it did.
    void keep_key_moments() { keys_wanted_ = true; }

    const FilmedScene& scene() const override { return scene_; }
    Supply supply() const override { return {true, true, true, scene_.keeps_orientations()}; }
    Span span() const override;
    std::vector<Frame> moments(const Pictures& pictures) const override;
    // After packing: opens the files. Pictures before the run's first step do not come.
    void start(const Pictures& pictures) override;
    // To the next picture, keeping on the way what is to be kept.
    std::optional<Taken> next(const GoOn& go_on) override;
    // What was found of the bed's periods so far.
    std::vector<std::string> news() const override;

    // Of a run that was packed, in whatever state: last row of measures, end state, checkpoint. Nothing when
    // its folder is gone.
    void close(FirstFailure& failure);

    const Plan& plan() const { return plan_; }
    const Simulation& simulation() const { return simulation_; }
    const StageTimes& times() const { return times_; }
    const std::optional<RunFiles>& files() const { return files_; }
    bool packed() const { return packed_; }
    std::int64_t shots() const { return shots_; }          // pictures that come, at most
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
    class Parts;  // what it has for pictures

    void let_former_go(bool at_its_end);
    std::vector<Shot> shots_of(const Pictures& pictures) const;
    void want_moments(const std::vector<Shot>& shots);
    std::optional<Taken> waiting();  // another picture of the frame taken last
    bool advance_to(std::int64_t target, const GoOn& go_on);
    void leave_out_pictures(Stop& stop);
    FramePtr serve(const Stop& stop);
    void look_at_bed_periods();
    void add_measures();
    const FilmSegment& rule(int segment) const { return segments_.at(static_cast<std::size_t>(segment)); }
    bool ring_due() const;
    void save_checkpoint();
    void open_files(const std::vector<Shot>& shots);
    std::filesystem::path path_of(const char* file) const { return folder_->folder() / file; }

    FilmedScene scene_;
    Plan plan_;
    Simulation simulation_;
    const FolderLock* folder_ = nullptr;
    std::string program_version_;  // as files tell it
    PackingResult packing_;
    bool packed_ = false;
    std::int64_t first_step_ = 0, shots_ = 0;
    bool keys_wanted_ = false;
    bool goes_on_ = false;           // in the folder of an earlier run, which it is
    std::size_t pictures_kept_ = 0;  // of that
    std::int64_t former_end_ = 0;    // step
    bool former_kept_ = false, changed_ = false;
    std::vector<AcceptedKey> accepted_;
    ReadyFiles ready_;
    std::optional<EarlierPictures> earlier_;
    std::optional<RunFiles> files_;
    std::optional<Agenda> agenda_;
    std::vector<std::string> news_;  // of what is found when it starts
    std::optional<BedPeriods> bed_periods_;
    std::vector<FilmSegment> segments_;  // of the film
    std::optional<PictureParts> parts_;
    KeptMoments kept_;
    FramePtr frame_;                     // taken last
    std::vector<int> segments_waiting_;  // of its pictures that are yet to come
    StageTimes times_;
    Pace pace_;
    CheckpointPace checkpoints_;
    std::optional<CheckpointRing> ring_;
    double particle_steps_ = 0;                // of vibration
    RecentRate rate_;                          // particle-steps/s
    std::optional<std::uint64_t> state_hash_;  // of the end state
    std::optional<TableMark> final_table_;     // of its table
};

}  // namespace grainreel
