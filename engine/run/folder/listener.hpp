// Listeners are told what a run does, and may ask it to stop; one of them writes the run's log. Nothing here
// prints or ends the process: the caller of a run decides where messages go.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/base/error.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/files/run_json.hpp"
#include "engine/run/driver/pace.hpp"
#include "engine/run/replay/replay.hpp"

namespace spdlog {
class logger;
}

namespace grainreel {

// The progress of a run.
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
        exporting,
        reading
    };
    Stage stage = Stage::growing;
    double done = 0;                              // share of this stage, 0 to 1
    std::string what;                             // subject while charting, timing, studying or exporting
    double time = 0, end = 0;                     // s simulated, while vibrating
    double particle_steps_per_second = 0;         // 0 if not known yet
    std::int64_t frames = 0, frames_planned = 0;  // frames of the film; frames_planned is 0 without a film
    double elapsed = 0;                           // s of wall time since the run began
    double remaining = -1;                        // s of wall time; negative if not known yet
};

// "0.4 s", "45 s", "1 min 05 s", "2 h 03 min".
std::string duration_text(double seconds);

class Listener {
  public:
    virtual ~Listener() = default;

    // Messages, a line each, called on the thread that runs.
    virtual void detail(const std::string& text) = 0;  // for detailed logs
    virtual void info(const std::string& text) = 0;
    virtual void warning(const std::string& text) = 0;
    virtual void error(const std::string& text) = 0;
    // Called as often as the run likes, on the thread that runs.
    virtual void progress(const Progress& progress) = 0;

    // The signal (SIGINT, say) that asked the run to end in good order; 0 if there was none. May be called on
    // any thread.
    virtual int stop_signal() const = 0;
    // Says that from now on there are results that must not be lost, even in a hurry.
    virtual void keep_before_exit() = 0;
    // Whether the run is to end at once, except for results that must be kept. May be called on any thread.
    virtual bool in_a_hurry() const = 0;
};

// A listener that ignores all messages and never asks the run to stop.
class SilentListener : public Listener {
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

// log.txt: it has every message of a run with its time. Each line is on disk when the call returns. A full
// disk costs lines of the log but never ends the run.
class RunLog {
  public:
    // goes_on: new lines follow those of an existing file. Throws RunError when the file cannot be made.
    explicit RunLog(const std::filesystem::path& path, bool goes_on = false);
    ~RunLog();

    void info(const std::string& message);
    void warning(const std::string& message);
    void error(const std::string& message);

  private:
    std::unique_ptr<spdlog::logger> logger_;
};

// Passes everything on, and also writes the messages to a log once there is one.
class LoggingListener final : public Listener {
  public:
    explicit LoggingListener(Listener& to) : to_(to) {}
    void keep_log(RunLog* log) { log_ = log; }  // null ends the log

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
    Listener& to_;
    RunLog* log_ = nullptr;
};

// Makes a watcher that reports the progress of a replay to `tell`, with the remaining time, once the replay
// has taken a second. It never stops the replay.
ReplayWatcher replay_progress(std::function<void(const Progress&)> tell);

// Objects that all parts working on one run's folder share.
struct JobDesk {
    explicit JobDesk(Listener& to) : listener(to) {}

    LoggingListener listener;
    std::optional<RunFolder> folder;  // once it is made
    std::optional<RunLog> log;        // once the folder is made
    RunJson record;                   // run.json
    StageTimes times;
    Stopwatch watch;  // since the run began
    FirstFailure failure;
};

}  // namespace grainreel
