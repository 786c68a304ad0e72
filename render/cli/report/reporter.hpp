// All that goes to stderr: messages and the progress line, which redraws on a terminal and comes now and then
// in a pipe. Messages go to the run's log as well.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "engine/output/log.hpp"
#include "render/cli/report/progress_text.hpp"

namespace grainreel {

struct ReporterOptions {
    enum class Form { automatic, json, none };  // of the progress
    Form form = Form::automatic;
    bool quiet = false;    // errors only
    bool verbose = false;  // details too
};

class Reporter {
  public:
    explicit Reporter(const ReporterOptions& options);
    ~Reporter();

    // From here on messages go to the log too; nullptr ends that.
    void keep_log(RunLog* log) { log_ = log; }

    void detail(const std::string& text);  // shown with --verbose only, always logged
    void info(const std::string& text);
    void warning(const std::string& text);
    void error(const std::string& text);

    // As often as the caller likes: shows it when it is time to.
    void progress(const Progress& progress);
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
    RunLog* log_ = nullptr;
    bool line_shown_ = false;
    std::optional<Progress> last_;  // shown
    Watch::time_point last_time_;
};

}  // namespace grainreel
