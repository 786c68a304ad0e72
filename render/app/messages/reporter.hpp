// Prints all that the program says: results on stdout, messages and progress on stderr. The progress line is
// redrawn on a terminal, and printed now and then into a pipe. The reporter also tells a run that a signal
// has asked it to stop.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/run/folder/folder_job.hpp"
#include "engine/run/folder/listener.hpp"
#include "render/app/messages/stop_signal.hpp"
#include "render/film/sources/film_request.hpp"

namespace grainreel {

struct ReporterOptions {
    enum class Form { automatic, json, none };  // form of the progress
    Form form = Form::automatic;
    bool quiet = false;    // errors only
    bool verbose = false;  // details too
};

// Writes all that goes to stderr.
class Reporter final : public Listener {
  public:
    explicit Reporter(const ReporterOptions& options);
    ~Reporter() override;

    void detail(const std::string& text) override;  // shown with --verbose only
    void info(const std::string& text) override;
    void warning(const std::string& text) override;
    void error(const std::string& text) override;
    // Shows the progress if enough time has passed since it was last shown.
    void progress(const Progress& progress) override;

    int stop_signal() const override;
    void keep_before_exit() override;
    bool in_a_hurry() const override;

    // The words that a signal handler writes when it ends the program at once; empty when only errors are
    // shown.
    std::string last_words() const;
    // Takes the progress line off the terminal.
    void clear();
    // From now on, messages name the files that an import was made of, in place of its folder in the cache.
    void name_import(const std::filesystem::path& folder, const std::filesystem::path& from);

  private:
    using Watch = std::chrono::steady_clock;
    bool due(const Progress& progress, Watch::time_point now) const;
    void print(const char* kind, const char* colour, const std::string& text);
    std::string line(const char* kind, const char* colour, const std::string& text) const;

    ReporterOptions options_;
    bool terminal_ = false, coloured_ = false;
    bool line_shown_ = false;
    std::optional<Progress> last_;  // the progress shown last
    Watch::time_point last_time_;
    std::vector<std::pair<std::filesystem::path, std::filesystem::path>> imports_;  // folder, its files
};

std::string to_string(Progress::Stage stage);

// "vibrating  3.20 of 10.00 s   12.4 M particle-steps/s   frame 96 of 300   1 min 05 s left", without
// the last parts when it is longer than `width` columns.
std::string progress_line(const Progress& progress, int width);

// The progress as a JSON object in one line, without the line's end.
std::string progress_json(const Progress& progress);

// Shows the progress of work that reports the share done (charts and benches), with the time left, and says
// whether to go on.
class ShareWatcher {
  public:
    ShareWatcher(Reporter& reporter, Progress::Stage stage)
        : reporter_(reporter), stage_(stage), begin_(std::chrono::steady_clock::now()) {}

    // done: 0 to 1. Returns false after a signal to stop.
    bool operator()(const std::string& what, double done) const {
        Progress progress;
        progress.stage = stage_;
        progress.what = what;
        progress.done = done;
        progress.elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
        if (done > 0.02) progress.remaining = progress.elapsed * (1 - done) / done;
        reporter_.progress(progress);
        return stop_signal() == 0;
    }

  private:
    Reporter& reporter_;
    Progress::Stage stage_;
    std::chrono::steady_clock::time_point begin_;
};

// From here on: the results of the program, such as the folder that it made, a plan, figures, help.

// Prints a text of many lines. Control characters that came with a title or a name are made visible. A
// failure to write is remembered for close_results().
void print_result(std::string_view text);

// Prints text that scripts use as it is, such as the name of a folder or a command. Control characters are
// made visible on a terminal only.
void print_exact(std::string_view text);

// If the program was started without stdin, stdout or stderr (`>&-`), opens something harmless in their
// place. Else a file of the run would get the number of a stream, and messages would be written into it. If
// anything is printed on such a stdout, close_results() throws. Call this before anything else is opened.
void open_missing_streams();

// Call it once, at the end. Throws RunError when some of the results could not be written. A reader that
// closes the pipe is no failure.
void close_results();

// Prints the run's folder on stdout, or on stderr if the film went to stdout. Returns the exit status.
int tell_folder(const FolderJob::Ended& ended, const FilmRequest& request);

}  // namespace grainreel
