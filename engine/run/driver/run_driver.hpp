// Runs one scene: packs the grains, goes from one wanted frame to the next, and writes the files in the run's
// folder. It prints nothing and draws nothing.
//
// Call use_folder(), pack(), start(), next() until it gives nothing, and close(), in this order.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/files/folder_lock.hpp"
#include "engine/files/run_json.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/driver/agenda.hpp"
#include "engine/run/driver/pace.hpp"
#include "engine/run/driver/run_files.hpp"
#include "engine/run/replay/checkpoint_ring.hpp"
#include "engine/run/resume/kept_files.hpp"
#include "engine/run/resume/resume_point.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class RunDriver {
  public:
    // Called about every tenth of a second. It returns false to stop the run.
    using GoOn = std::function<bool()>;

    // Throws UserError for mistakes in scene or plan. Nothing is on disk then.
    RunDriver(const Scene& scene, const Plan& plan, int threads);
    // A run that goes on (is resumed) in its folder. It is already packed.
    RunDriver(const Scene& scene, const Plan& plan, ResumePoint point);
    RunDriver(const RunDriver&) = delete;
    RunDriver& operator=(const RunDriver&) = delete;

    // Writes scene.toml and the files of meshes there; the other files follow with start(). The lock must
    // outlive the run. From here on pack() and next() throw RunError soon after the folder is gone.
    // `previous` is as in keep_mesh_files().
    void use_folder(const FolderLock& folder, const std::string& program_version,
                    const std::filesystem::path& previous = {});
    // Call this for a run that goes on, before use_folder(). It checks all files of the run. It also keeps
    // the present state of the folder until the run has gone past the step that it had reached before (its
    // former end). `hands_out` says whether frames will be handed out, so that film_moments.nc goes on.
    // Throws UserError or RunError; nothing in the folder has changed then.
    void keep_former(const FolderLock& folder, bool hands_out, const std::string& program_version);
    // Whether the run goes on and has not yet reached its former end.
    bool is_behind_former() const { return former_kept_; }
    // Closes the files and restores the folder as it was. Nothing else may be called afterwards.
    void put_back();
    // Lets pack() use a packing that an earlier run has kept in the user's cache folder, and keep its own
    // there if it took `shortest` seconds or longer. The bits of the run do not change.
    void keep_packings(double shortest) { shortest_kept_ = shortest; }
    // Returns false if the watcher stopped it.
    bool pack(const PackingWatcher& watcher);
    const PackingResult& packing() const { return packing_; }
    // A line about the packing that pack() found; empty if it made the packing itself.
    std::string found_packing_text() const;

    // Opens the files. Call it after packing.
    void start(FilmWishes wishes);
    // Goes to the next step at which a frame is wanted, writes the files of the scene on the way, and hands
    // the frame out. Returns null after the last frame (the run is then at its end), and if it was told to
    // stop. Throws RunError if the run is not healthy, a file cannot be written, or the folder is gone.
    std::shared_ptr<State> next(const GoOn& go_on);
    // An earlier moment that the frame of the last next() needs; null if it was not kept.
    StatePtr kept(std::int64_t step) const { return kept_.at(step); }
    // Findings when the run started, a line each.
    const std::vector<std::string>& news() const { return news_; }

    // Writes the last row of measures, the end state and the checkpoint. Call it after packing, whatever
    // happened. It does nothing if the folder is gone.
    void close(FirstFailure& failure);

    const Scene& scene() const { return scene_; }
    const Plan& plan() const { return plan_; }
    const SimulatedBed& simulation() const { return simulation_; }
    const StageTimes& times() const { return times_; }
    const std::optional<RunFiles>& files() const { return files_; }            // from start() on
    const std::filesystem::path& folder() const { return folder_->folder(); }  // from use_folder() on
    bool packed() const { return packed_; }
    // Whether the scene asks for formats of other programs, and there are frames to write in them.
    bool has_other_formats() const {
        return scene_.output.also.any() && files_ && files_->trajectory_frames() > 0;
    }
    bool goes_on() const { return goes_on_; }                // whether the run goes on in its folder
    std::int64_t first_step() const { return first_step_; }  // step at which the drive began, once packed
    // Number of frames in film_moments.nc that were handed out before, for a run that goes on.
    std::size_t frames_before() const { return frames_before_; }
    double done() const;                                   // share of the vibration
    double recent_speed() const { return rate_.value(); }  // particle-steps/s
    double speed() const;                                  // particle-steps/s, time in the engine alone

    std::string packing_text() const;
    // Lines about the packing for the user. They are to be asked for before the run goes on.
    std::vector<std::string> packing_warnings() const;
    // A line about the contact that overlapped far more than planned, if any has.
    std::optional<std::string> overlap_warning() const;
    // "trajectory.nc (4 frames), measures.csv (30 rows), ..."
    std::string files_text() const;
    // describe() adds to the record what is known when the run begins, and conclude() what is known when it
    // has ended.
    void describe(RunJson& record) const;
    void conclude(RunJson& record) const;

  private:
    bool take_kept_packing(const std::string& key);
    void keep_packing_of(const std::string& key, const PackingResult& result, double seconds);
    std::optional<std::string> settling_warning() const;
    void let_former_go(bool at_its_end);
    void open_files();
    bool advance_to(std::int64_t target, const GoOn& go_on);
    std::shared_ptr<State> serve(const Stop& stop);
    void add_measures();
    bool ring_due() const;
    void save_checkpoint();
    std::filesystem::path path_of(const char* file) const { return folder_->folder() / file; }

    Scene scene_;
    Plan plan_;
    SimulatedBed simulation_;
    const FolderLock* folder_ = nullptr;
    std::string program_version_;  // as written in files
    PackingResult packing_;
    bool packed_ = false;
    std::optional<double> shortest_kept_;  // s, shortest time of packings that are kept
    bool found_packing_ = false;
    std::string not_kept_;  // why the packing could not be kept
    std::int64_t first_step_ = 0;
    bool goes_on_ = false;
    std::size_t frames_before_ = 0;
    std::int64_t former_end_ = 0;  // step
    bool former_kept_ = false, changed_ = false;
    std::vector<AcceptedKey> accepted_;
    std::optional<double> settled_;  // s, of the packing; none if nothing settled
    ReadyFiles ready_;
    FilmWishes wishes_;
    KeptStates kept_;
    std::optional<std::int64_t> handed_out_;  // step of the last frame
    std::optional<RunFiles> files_;
    std::optional<Agenda> agenda_;
    std::vector<std::string> news_;
    StageTimes times_;
    Pace pace_;
    CheckpointPace checkpoints_;
    std::optional<CheckpointRing> ring_;
    double particle_steps_ = 0;                // particle steps of the vibration
    RecentRate rate_;                          // particle-steps/s
    std::optional<std::uint64_t> state_hash_;  // hash of the end state
    std::optional<TableMark> final_table_;     // mark of the end state's table
};

}  // namespace grainreel
