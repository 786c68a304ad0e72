// All that goes to stderr: messages and the progress line, which redraws on a terminal and comes now and then
// in a pipe. Signals are what asks a run to stop.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "engine/run/folder/listener.hpp"

namespace grainreel {

struct ReporterOptions {
    enum class Form { automatic, json, none };  // of the progress
    Form form = Form::automatic;
    bool quiet = false;    // errors only
    bool verbose = false;  // details too
};

class Reporter final : public RunListener {
  public:
    explicit Reporter(const ReporterOptions& options);
    ~Reporter() override;

    void detail(const std::string& text) override;  // shown with --verbose only
    void info(const std::string& text) override;
    void warning(const std::string& text) override;
    void error(const std::string& text) override;
    // Shows it when it is time to.
    void progress(const Progress& progress) override;

    int stop_signal() const override;
    void keep_before_exit() override;
    bool in_a_hurry() const override;

    // What a signal handler is to write when it ends the program at once; empty when only errors are shown.
    std::string last_words() const;
    // Takes the progress line off the terminal.
    void clear();

  private:
    using Watch = std::chrono::steady_clock;
    bool due(const Progress& progress, Watch::time_point now) const;
    void print(const char* kind, const char* colour, const std::string& text);
    std::string line(const char* kind, const char* colour, const std::string& text) const;

    ReporterOptions options_;
    bool terminal_ = false, coloured_ = false;
    bool line_shown_ = false;
    std::optional<Progress> last_;  // shown
    Watch::time_point last_time_;
};

}  // namespace grainreel
