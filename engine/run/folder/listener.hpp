// Who is told what a run does, and who may ask it to stop. Nothing here prints or ends the process: the
// caller of a run decides where the words go.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "engine/files/log.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/files/run_json.hpp"
#include "engine/run/driver/first_failure.hpp"
#include "engine/run/driver/pace.hpp"
#include "engine/run/replay/replay.hpp"

namespace grainreel {

// How far a run has come.
struct Progress {
    enum class Stage {
        growing,
        raining,
        settling,
        vibrating,
        charting,
        timing,
        drawing,
        studying,
        replaying,
        paging,
        exporting
    };
    Stage stage = Stage::growing;
    double done = 0;                              // of this stage, 0 to 1
    std::string what;                             // while charting, timing or studying
    double time = 0, end = 0;                     // s simulated, while vibrating
    double particle_steps_per_second = 0;         // 0: not known yet
    std::int64_t frames = 0, frames_planned = 0;  // of the film; planned 0: no film
    double elapsed = 0;                           // s of wall time since the run began
    double remaining = -1;                        // s of wall time; negative: not known yet
};

// "0.4 s", "45 s", "1 min 05 s", "2 h 03 min".
std::string duration_text(double seconds);

class RunListener {
  public:
    virtual ~RunListener() = default;

    // Messages, a line each. On the thread that runs.
    virtual void detail(const std::string& text) = 0;  // for those who want to know all
    virtual void info(const std::string& text) = 0;
    virtual void warning(const std::string& text) = 0;
    virtual void error(const std::string& text) = 0;
    // As often as the run likes. On the thread that runs.
    virtual void progress(const Progress& progress) = 0;

    // The signal (SIGINT, say) that asked the run to end in good order; 0 while none did. On any thread.
    virtual int stop_signal() const = 0;
    // From now on there is something that must not be lost, however much of a hurry there is.
    virtual void keep_before_exit() = 0;
    // Whether the run is to end at once, apart from what must be kept. On any thread.
    virtual bool in_a_hurry() const = 0;
};

// Tells nobody anything, and nobody asks the run to stop.
class SilentListener : public RunListener {
  public:
    void detail(const std::string&) override {}
    void info(const std::string&) override {}
    void warning(const std::string&) override {}
    void error(const std::string&) override {}
    void progress(const Progress&) override {}
    int stop_signal() const override { return 0; }
    void keep_before_exit() override {}
    bool in_a_hurry() const override { return false; }
};

// Passes everything on, and writes the messages to a log too once there is one.
class LoggingListener final : public RunListener {
  public:
    explicit LoggingListener(RunListener& to) : to_(to) {}
    void keep_log(RunLog* log) { log_ = log; }  // null ends that

    void detail(const std::string& text) override {
        if (log_ != nullptr) log_->info(text);
        to_.detail(text);
    }
    void info(const std::string& text) override {
        if (log_ != nullptr) log_->info(text);
        to_.info(text);
    }
    void warning(const std::string& text) override {
        if (log_ != nullptr) log_->warning(text);
        to_.warning(text);
    }
    void error(const std::string& text) override {
        if (log_ != nullptr) log_->error(text);
        to_.error(text);
    }
    void progress(const Progress& progress) override { to_.progress(progress); }
    int stop_signal() const override { return to_.stop_signal(); }
    void keep_before_exit() override { to_.keep_before_exit(); }
    bool in_a_hurry() const override { return to_.in_a_hurry(); }

  private:
    RunListener& to_;
    RunLog* log_ = nullptr;
};

// A watcher that tells how far a replay has come. It tells `tell` once the replay has gone on for a second,
// with the time that is left. It never stops the replay.
ReplayWatcher replay_progress(std::function<void(const Progress&)> tell);

// What all parts that work on one run's folder share.
struct RunDesk {
    explicit RunDesk(RunListener& to) : listener(to) {}

    LoggingListener listener;
    std::optional<RunFolder> folder;  // once it is made
    std::optional<RunLog> log;        // once the folder is made
    RunJson record;                   // run.json
    StageTimes times;
    Stopwatch watch;  // since the run began
    FirstFailure failure;
};

}  // namespace grainreel
