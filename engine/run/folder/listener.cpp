#include "engine/run/folder/listener.hpp"

#include <fmt/format.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <cmath>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "engine/run/driver/pace.hpp"

namespace grainreel {

std::string duration_text(double seconds) {
    if (seconds < 9.95 && seconds != std::floor(seconds)) return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<std::int64_t>(std::llround(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

RunLog::RunLog(const std::filesystem::path& path, bool goes_on) {
    if (const std::string other = other_than_file(path, false); !other.empty() && other != "a device")
        throw RunError("{}: cannot be written: it is {}", path.string(), other);
    try {
        auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(path.string(), !goes_on);
        logger_ = std::make_unique<spdlog::logger>("run", std::move(sink));
    } catch (const spdlog::spdlog_ex& problem) {
        throw RunError(problem.what());
    }
    logger_->set_pattern("%Y-%m-%d %H:%M:%S.%e  %-7l  %v");
    logger_->flush_on(spdlog::level::trace);
    logger_->set_error_handler([](const std::string&) {});
}

RunLog::~RunLog() = default;

void RunLog::info(const std::string& message) {
    logger_->log(spdlog::level::info, message_text(message));
}
void RunLog::warning(const std::string& message) {
    logger_->log(spdlog::level::warn, message_text(message));
}
void RunLog::error(const std::string& message) {
    logger_->log(spdlog::level::err, message_text(message));
}

ReplayWatcher replay_progress(std::function<void(const Progress&)> tell) {
    return [tell = std::move(tell), watch = Stopwatch()](double done) {
        Progress progress;
        progress.stage = Progress::Stage::replaying;
        progress.done = done;
        progress.elapsed = watch.seconds();
        if (progress.elapsed < 1) return true;
        if (done > 0) progress.remaining = progress.elapsed * (1 - done) / done;
        tell(progress);
        return true;
    };
}

}  // namespace grainreel
