// To whom a run tells what it does, and who may ask it to stop. Nothing here prints or ends the process:
// whoever runs a scene decides where the words go.
#pragma once

#include <string>

#include "engine/files/log.hpp"
#include "engine/run/folder/progress.hpp"

namespace grainreel {

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
    // From here there is something that may not be lost, however much of a hurry there is.
    virtual void keep_before_exit() = 0;
    // Whether it is to end at once, but for what is to be kept. On any thread.
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

}  // namespace grainreel
