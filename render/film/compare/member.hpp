// A member of a comparison, shown in one panel of its film: a scene that is run in its own folder with its
// own run.json, or a run that lies on disk.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/files/folder_lock.hpp"
#include "engine/files/run_json.hpp"
#include "engine/run/folder/folder_job.hpp"
#include "render/film/sources/live_shots.hpp"
#include "render/film/sources/shot_source.hpp"
#include "render/film/sources/stored_shots.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class ComparedMember {
  public:
    using GoOn = ShotSource::GoOn;

    ComparedMember(const FilmedScene& scene, const Plan& plan, int threads);
    explicit ComparedMember(std::unique_ptr<StoredShots> record)
        : record_(record.get()), source_(std::move(record)) {}

    const ShotSource& source() const { return *source_; }
    const FilmedScene& scene() const { return source_->scene(); }
    const StateArchive* archive() const { return source_->archive(); }  // null for a scene that is run
    const RunDriver* run() const { return driver_.get(); }              // null for a run on disk
    const StoredShots* record() const { return record_; }               // null for a scene that is run
    const Clock& clock() const { return driver_ ? driver_->plan().clock : record_->clock(); }
    // Where the member's files are, as run.json of the whole film tells it.
    std::string place() const;

    // begin(), pack(), start() and next() are called in this order. A scene that is run calls `go_on` now and
    // then and stops when that returns false; pack() then returns false, and next() null.
    void begin(const std::filesystem::path& folder, const JobRequest& request);
    bool pack(const GoOn& go_on);
    // What the user should know of the run, a line each.
    std::vector<std::string> news() const;
    std::string found_packing_text() const { return driver_ ? driver_->found_packing_text() : ""; }
    void start(const Pictures& pictures);
    ShotPtr next(const GoOn& go_on);  // null also after the last picture; the rest of the run is then done

    // At the end keep_state() and then close() are called, whatever happened before. close() completes
    // run.json and may be called twice. status: that of the whole film. If only another member has failed,
    // this one counts as interrupted.
    void keep_state();
    // Writes the formats of other programs that the scene asks for. watcher: see write_also()
    // (engine/run/driver/also_exports.hpp).
    void write_other_formats(const std::function<bool(const std::string&, double)>& watcher);
    void close(RunStatus status, int exit_status, FirstFailure& failure);
    void note_failure(const std::string& what) { failed_.note(what); }

    // For the progress line: the share of the member's work that is done, and its speed.
    double done() const { return done_; }
    double speed() const { return speed_; }  // particle-steps/s

  private:
    std::unique_ptr<RunDriver> driver_;    // for a scene that is run: its driver
    const StoredShots* record_ = nullptr;  // for a run on disk: source_
    std::unique_ptr<ShotSource> source_;
    std::optional<FolderLock> folder_;  // lock of the run's folder, once that is made
    RunJson report_;                    // run.json of what is run
    std::atomic<double> done_ = 0, speed_ = 0;
    FirstFailure failed_;  // first failure of this member's own work
};

}  // namespace grainreel
