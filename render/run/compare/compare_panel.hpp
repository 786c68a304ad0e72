// One panel of `compare`: a scene that is run, or a finished run that is read.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/output/folder_lock.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/run/finished_run.hpp"
#include "render/run/scene_run.hpp"

namespace grainreel {

class ComparePanel {
  public:
    virtual ~ComparePanel() = default;
    virtual const Scene& scene() const = 0;
    // Where its files are, as run.json of the whole tells it.
    virtual std::string place() const = 0;

    // In this order. What runs says so by `go_on`, now and then, and stops when that is false: then pack()
    // and finish() return false and next() nothing.
    virtual void begin(const std::filesystem::path& folder, const std::string& command) = 0;
    virtual bool pack(const SceneRun::GoOn& go_on) = 0;
    // Of each instant the moment that this panel shows, without its grains.
    virtual std::vector<Frame> moments(const std::vector<Instant>& instants,
                                       const std::vector<FilmSegment>& segments) const = 0;
    virtual void start(const std::vector<Instant>& instants, const std::vector<FilmSegment>& segments) = 0;
    virtual FramePtr next(const SceneRun::GoOn& go_on) = 0;  // of the next instant
    virtual bool finish(const SceneRun::GoOn& go_on) = 0;    // what remains of the run after the last
    virtual std::vector<std::string> news() const = 0;       // what was found while it ran, a line each
    // After all that, whatever happened: the end state; then the record of its run. status: of the whole;
    // where another panel has failed, this one was interrupted. close() may be called twice.
    virtual void keep_state() = 0;
    virtual void close(RunStatus status, int exit_status, FirstFailure& failure) = 0;
    void note_failure(const std::string& what) { failed_.note(what); }

    // Of another thread's work; for the progress line.
    double done() const { return done_; }
    double speed() const { return speed_; }  // particle-steps/s

  protected:
    std::atomic<double> done_ = 0, speed_ = 0;
    FirstFailure failed_;  // of this panel's own work
};

class LivePanel final : public ComparePanel {
  public:
    LivePanel(const Scene& scene, const Plan& plan, int threads) : run_(scene, plan, threads) {}
    const Scene& scene() const override { return run_.scene(); }
    const SceneRun& run() const { return run_; }
    std::string place() const override { return run_.scene().name; }
    void begin(const std::filesystem::path& folder, const std::string& command) override;
    bool pack(const SceneRun::GoOn& go_on) override;
    std::vector<Frame> moments(const std::vector<Instant>& instants,
                               const std::vector<FilmSegment>& segments) const override;
    void start(const std::vector<Instant>& instants, const std::vector<FilmSegment>& segments) override;
    FramePtr next(const SceneRun::GoOn& go_on) override;
    bool finish(const SceneRun::GoOn& go_on) override;
    std::vector<std::string> news() const override { return run_.news(); }
    void keep_state() override;
    void close(RunStatus status, int exit_status, FirstFailure& failure) override;

  private:
    SceneRun::GoOn noting(const SceneRun::GoOn& go_on);
    SceneRun run_;
    std::optional<FolderLock> folder_;  // once it is made
    RunRecord record_;
    FramePtr frame_;         // shown last
    std::size_t again_ = 0;  // how often that frame is to be shown yet
};

class RecordedPanel final : public ComparePanel {
  public:
    RecordedPanel(const std::filesystem::path& folder, const Assignments& sets) : run_(folder, sets) {
        run_.leave_out_damaged();
    }
    const Scene& scene() const override { return run_.scene(); }
    const FinishedRun& run() const { return run_; }
    std::string place() const override { return std::filesystem::absolute(run_.folder()).string(); }
    void begin(const std::filesystem::path&, const std::string&) override {}
    bool pack(const SceneRun::GoOn&) override { return true; }
    std::vector<Frame> moments(const std::vector<Instant>& instants,
                               const std::vector<FilmSegment>& segments) const override;
    void start(const std::vector<Instant>& instants, const std::vector<FilmSegment>& segments) override;
    FramePtr next(const SceneRun::GoOn& go_on) override;
    bool finish(const SceneRun::GoOn&) override { return true; }
    std::vector<std::string> news() const override { return {}; }
    void keep_state() override {}
    void close(RunStatus, int, FirstFailure&) override {}

  private:
    FinishedRun run_;
    std::vector<std::size_t> frames_;  // one an instant
    std::size_t next_ = 0;
};

}  // namespace grainreel
