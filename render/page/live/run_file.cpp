#include "render/page/live/run_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <string_view>
#include <utility>

namespace grainreel {
namespace {

constexpr std::array<std::pair<std::string_view, const char*>, 10> types{{
    {".html", "text/html; charset=utf-8"},
    {".csv", "text/csv; charset=utf-8"},
    {".toml", "text/plain; charset=utf-8"},
    {".txt", "text/plain; charset=utf-8"},
    {".json", "application/json"},
    {".mp4", "video/mp4"},
    {".webm", "video/webm"},
    {".png", "image/png"},
    {".gif", "image/gif"},
    {".nc", "application/x-netcdf"},
}};

bool is_plain_name(std::string_view name) {
    return !name.empty() && name.front() != '.' && name.find('/') == std::string_view::npos &&
           name.find('\0') == std::string_view::npos;
}

}  // namespace

WatchAnswer run_file(const std::filesystem::path& folder, const std::string& path) {
    const auto none = [] { return text_answer(404, "There is no such file in the run's folder.\n"); };
    const std::string name = path.empty() ? path : path.substr(1);
    if (!is_plain_name(name)) return none();
    const int place = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (place < 0) return none();
    const int file = ::openat(place, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    ::close(place);
    if (file < 0) return none();
    struct stat about {};
    if (::fstat(file, &about) != 0 || !S_ISREG(about.st_mode)) {
        ::close(file);
        return none();
    }
    WatchAnswer answer;
    answer.file = file;
    answer.file_size = static_cast<std::uint64_t>(about.st_size);
    answer.type = "application/octet-stream";
    for (const auto& [end, type] : types)
        if (name.ends_with(end)) answer.type = type;
    return answer;
}

}  // namespace grainreel
