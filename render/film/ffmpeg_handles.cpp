#include "render/film/ffmpeg_handles.hpp"

#include <array>
#include <cstdarg>
#include <cstdio>
#include <mutex>
#include <utility>

namespace grainreel {
namespace {

struct ErrorLog {
    std::mutex mutex;
    std::string last;
};

// Codecs log from their own threads, up to the end of the process: never destroyed.
ErrorLog& error_log() {
    static ErrorLog& log = *new ErrorLog;
    return log;
}

void collect(void*, int level, const char* format, std::va_list arguments) {
    if (level > AV_LOG_ERROR) return;
    std::array<char, 512> line{};
    std::vsnprintf(line.data(), line.size(), format, arguments);
    std::string text = line.data();
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    if (text.empty()) return;
    ErrorLog& log = error_log();
    const std::scoped_lock lock(log.mutex);
    log.last = std::move(text);
}

}  // namespace

void quiet_ffmpeg() {
    static std::once_flag once;
    std::call_once(once, [] { av_log_set_callback(collect); });
}

std::string ffmpeg_error(int code) {
    std::array<char, AV_ERROR_MAX_STRING_SIZE> reason{};
    av_strerror(code, reason.data(), reason.size());
    ErrorLog& log = error_log();
    const std::scoped_lock lock(log.mutex);
    const std::string detail = std::exchange(log.last, {});
    return detail.empty() ? reason.data() : std::string(reason.data()) + " (" + detail + ")";
}

}  // namespace grainreel
