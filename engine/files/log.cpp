#include "engine/files/log.hpp"

#include <fmt/format.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"

namespace grainreel {

RunLog::RunLog(const std::filesystem::path& path, bool goes_on) {
    if (const std::string other = other_than_file(path, false); !other.empty() && other != "a device")
        throw RunError(fmt::format("{}: cannot be written: it is {}", path.string(), other));
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

}  // namespace grainreel
