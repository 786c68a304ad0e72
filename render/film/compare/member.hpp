// One source of a film that shows several: a scene that is run, in a folder of its own with a run.json of its
// own, or a run that lies on disk.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/folder_lock.hpp"
#include "engine/files/run_json.hpp"
#include "engine/run/driver/first_failure.hpp"
#include "engine/run/folder/folder_run.hpp"
#include "render/film/sources/frame_source.hpp"
#include "render/film/sources/revisited_run.hpp"
#include "render/film/sources/scene_run.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class ComparedMember {
  public:
    using GoOn = FrameSource::GoOn;

    ComparedMember(const FilmedScene& scene, const Plan& plan, int threads);
    explicit ComparedMember(std::unique_ptr<RevisitedRun> record)
        : record_(record.get()), source_(std::move(record)) {}

    const FrameSource& source() const { return *source_; }
    const FilmedScene& scene() const { return source_->scene(); }
    const FrameArchive* archive() const { return source_->archive(); }  // null for what is run
    const RunDriver* run() const { return driver_.get(); }              // null for a record
    const RevisitedRun* record() const { return record_; }              // null for what is run
    const Clock& clock() const { return driver_ ? driver_->plan().clock : record_->clock(); }
    // Where its files are, as run.json of the whole tells it.
    std::string place() const;

    // In this order. What is run says so by `go_on`, now and then, and stops when that is false: then pack()
    // is false, and next() nothing.
    void begin(const std::filesystem::path& folder, const RunRequest& request);
    bool pack(const GoOn& go_on);
    std::string found_packing_text() const { return driver_ ? driver_->found_packing_text() : ""; }
    void start(const Pictures& pictures);
    FramePtr next(const GoOn& go_on);  // null after the last too, when what remains of the run is done

    // After all that, whatever happened: the end state; then the record of its run. status: of the whole;
    // where another member has failed, this one was interrupted. close() may be called twice.
    void keep_state();
    // Formats of other programs that its scene asks for. watcher: as in write_also().
    void write_other_formats(const std::function<bool(const std::string&, double)>& watcher);
    void close(RunStatus status, int exit_status, FirstFailure& failure);
    void note_failure(const std::string& what) { failed_.note(what); }

    // How far another thread's work is, for the progress line.
    double done() const { return done_; }
    double speed() const { return speed_; }  // particle-steps/s

  private:
    std::unique_ptr<RunDriver> driver_;     // of the source, when it is run
    const RevisitedRun* record_ = nullptr;  // of the source, when it lies on disk
    std::unique_ptr<FrameSource> source_;
    std::optional<FolderLock> folder_;  // of what is run, once it is made
    RunJson report_;                    // as above
    std::atomic<double> done_ = 0, speed_ = 0;
    FirstFailure failed_;  // of this member's own work
};

}  // namespace grainreel
