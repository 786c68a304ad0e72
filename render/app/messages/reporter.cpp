#include "render/app/messages/reporter.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/run/import/import_run.hpp"
#include "render/app/messages/stop_signal.hpp"

namespace grainreel {

namespace {

constexpr auto terminal_interval = std::chrono::milliseconds(100);
constexpr auto json_interval = std::chrono::milliseconds(500);
constexpr auto pipe_interval = std::chrono::seconds(5);
// A pipe gets the progress earlier when this share of a stage has been done since the last time, but not
// before pipe_shortest.
constexpr double pipe_share = 0.1;
constexpr auto pipe_shortest = std::chrono::seconds(1);

bool is_terminal() {
    const char* term = std::getenv("TERM");
    return ::isatty(STDERR_FILENO) != 0 && term != nullptr && std::strcmp(term, "dumb") != 0;
}

// By no-color.org, NO_COLOR switches colours off when it is set and not empty.
bool colour_wanted() {
    const char* no_color = std::getenv("NO_COLOR");
    return no_color == nullptr || *no_color == '\0';
}

int terminal_width() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

constexpr const char* wipe = "\r\033[K";  // clears the terminal's line

void put(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

}  // namespace

Reporter::Reporter(const ReporterOptions& options)
    : options_(options), terminal_(is_terminal()), coloured_(terminal_ && colour_wanted()) {}

Reporter::~Reporter() {
    clear();
}

void Reporter::detail(const std::string& text) {
    if (options_.verbose && !options_.quiet) print("detail", "", text);
}

void Reporter::info(const std::string& text) {
    if (!options_.quiet) print("info", "", text);
}

void Reporter::warning(const std::string& text) {
    if (!options_.quiet) print("warning", "\033[33m", text);
}

void Reporter::error(const std::string& text) {
    print("error", "\033[31m", text);
}

int Reporter::stop_signal() const {
    return grainreel::stop_signal();
}

void Reporter::keep_before_exit() {
    grainreel::keep_before_exit();
}

bool Reporter::in_a_hurry() const {
    return grainreel::in_a_hurry();
}

void Reporter::print(const char* kind, const char* colour, const std::string& text) {
    clear();
    put(line(kind, colour, text));
}

void Reporter::name_import(const std::filesystem::path& folder, const std::filesystem::path& from) {
    imports_.emplace_back(folder, from);
}

std::string Reporter::line(const char* kind, const char* colour, const std::string& said) const {
    std::string known = said;
    for (const auto& [folder, from] : imports_) known = named_as(std::move(known), folder, from);
    const std::string text = message_text(known);
    if (options_.form == ReporterOptions::Form::json) {
        const nlohmann::ordered_json object = {{"event", kind}, {"text", text}};
        return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    }
    const bool plain = *colour == '\0';
    if (plain) return text + "\n";
    if (coloured_) return std::string(colour) + kind + ":\033[0m " + text + "\n";
    return std::string(kind) + ": " + text + "\n";
}

std::string Reporter::last_words() const {
    if (options_.quiet) return "";
    const bool line_may_be_shown = terminal_ && options_.form == ReporterOptions::Form::automatic;
    return (line_may_be_shown ? wipe : "") +
           line("info", "", "stopped at once: what was not yet on disk is lost");
}

bool Reporter::due(const Progress& now, Watch::time_point time) const {
    if (!last_ || last_->stage != now.stage) return true;
    const auto since = time - last_time_;
    const bool finished = now.done >= 1 && last_->done < 1;
    if (options_.form == ReporterOptions::Form::json) return finished || since >= json_interval;
    if (terminal_) return finished || since >= terminal_interval;
    return since >= pipe_interval ||
           (since >= pipe_shortest && (finished || now.done - last_->done >= pipe_share));
}

void Reporter::progress(const Progress& progress) {
    if (options_.quiet || options_.form == ReporterOptions::Form::none) return;
    const Watch::time_point now = Watch::now();
    if (!due(progress, now)) return;
    last_ = progress;
    last_time_ = now;
    if (options_.form == ReporterOptions::Form::json) {
        put(progress_json(progress) + "\n");
    } else if (terminal_) {
        // One column stays free: a line that fills the last one would wrap on some terminals.
        put("\r" + progress_line(progress, terminal_width() - 1) + "\033[K");
        line_shown_ = true;
    } else {
        put(progress_line(progress, 200) + "\n");
    }
}

void Reporter::clear() {
    if (line_shown_) put(wipe);
    line_shown_ = false;
}

std::string to_string(Progress::Stage stage) {
    switch (stage) {
        case Progress::Stage::growing:
            return "growing";
        case Progress::Stage::raining:
            return "raining";
        case Progress::Stage::settling:
            return "settling";
        case Progress::Stage::charting:
            return "charting";
        case Progress::Stage::timing:
            return "timing";
        case Progress::Stage::drawing:
            return "drawing";
        case Progress::Stage::studying:
            return "studying";
        case Progress::Stage::replaying:
            return "replaying";
        case Progress::Stage::exporting:
            return "exporting";
        case Progress::Stage::reading:
            return "reading";
        case Progress::Stage::paging:
            return "page";
        case Progress::Stage::vibrating:
            break;
    }
    return "vibrating";
}

namespace {

// What people read of a stage. Not every bed vibrates, and radii that grow fill the container.
std::string words_of(Progress::Stage stage) {
    if (stage == Progress::Stage::vibrating) return "running";
    return stage == Progress::Stage::growing ? "filling" : to_string(stage);
}

}  // namespace

std::string progress_line(const Progress& p, int width) {
    std::vector<std::string> parts;
    if (p.stage == Progress::Stage::vibrating) {
        parts.push_back(fmt::format("{:<9} {:.2f} of {:.2f} s", words_of(p.stage), p.time, p.end));
    } else {
        parts.push_back(fmt::format("{:<9} {:3.0f} %", words_of(p.stage), 100 * p.done));
    }
    if (!p.what.empty()) parts.push_back(p.what);
    if (p.particle_steps_per_second > 0) {
        parts.push_back(fmt::format("{:.1f} M particle-steps/s", p.particle_steps_per_second * 1e-6));
    }
    if (p.frames_planned > 0) parts.push_back(fmt::format("frame {} of {}", p.frames, p.frames_planned));
    if (p.remaining >= 0) parts.push_back(duration_text(std::ceil(p.remaining)) + " left");

    std::string line;
    for (const std::string& part : parts) {
        const std::string longer = line.empty() ? part : line + "   " + part;
        if (static_cast<int>(longer.size()) > width) break;
        line = longer;
    }
    return line;
}

std::string progress_json(const Progress& p) {
    nlohmann::ordered_json object = {{"event", "progress"}, {"stage", to_string(p.stage)}, {"done", p.done}};
    if (p.stage == Progress::Stage::vibrating) {
        object["time_s"] = p.time;
        object["end_s"] = p.end;
    }
    if (!p.what.empty()) object["what"] = p.what;
    if (p.particle_steps_per_second > 0) object["particle_steps_per_second"] = p.particle_steps_per_second;
    if (p.frames_planned > 0) {
        object["frames"] = p.frames;
        object["frames_planned"] = p.frames_planned;
    }
    object["elapsed_s"] = p.elapsed;
    if (p.remaining >= 0) object["remaining_s"] = p.remaining;
    return object.dump();
}

namespace {

int first_error = 0;  // errno of the first result that could not be printed

void note_error() {
    if (first_error == 0) first_error = errno != 0 ? errno : EIO;
}

void put_out(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) note_error();
}

}  // namespace

void print_result(std::string_view text) {
    put_out(visible(text, "\n\t"));
}

void print_exact(std::string_view text) {
    ::isatty(STDOUT_FILENO) != 0 ? print_result(text) : put_out(text);
}

void open_missing_streams() {
    // open() returns the lowest free number, so each missing stream gets its own if the lowest is opened
    // first. Stdout is opened for reading alone, so that printing fails as it does without a stdout.
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0) [[maybe_unused]]
            const int opened = ::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

void close_results() {
    if (std::fflush(stdout) != 0) note_error();
    // EPIPE is no failure: a reader such as `head` has read what it wanted.
    if (first_error != 0 && first_error != EPIPE)
        throw RunError("stdout: cannot be written: {}", std::strerror(first_error));
}

int tell_folder(const FolderJob::Ended& ended, const FilmRequest& request) {
    if (ended.folder && request.to_stdout)
        std::fprintf(stderr, "%s\n", visible(ended.folder->string()).c_str());
    if (ended.folder && !request.to_stdout) print_exact(ended.folder->string() + "\n");
    return ended.exit_status;
}

}  // namespace grainreel
