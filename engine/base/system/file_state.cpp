#include "engine/base/system/file_state.hpp"

#include <sys/stat.h>
#include <mutex>
#include <system_error>
#include <vector>

namespace grainreel {

namespace fs = std::filesystem;

namespace {

std::int64_t nanoseconds(const timespec& time) {
    return std::int64_t{time.tv_sec} * 1000000000 + std::int64_t{time.tv_nsec};
}

std::mutex noting;
std::vector<FilesRead*> noting_now;  // guarded by `noting`

}  // namespace

FileState state_of(const struct stat& about) {
    return {static_cast<std::uint64_t>(about.st_size), static_cast<std::uint64_t>(about.st_dev),
            static_cast<std::uint64_t>(about.st_ino), nanoseconds(about.st_mtim), nanoseconds(about.st_ctim)};
}

std::optional<FileState> state_of_file(const fs::path& file) {
    struct stat about {};
    if (::stat(file.c_str(), &about) != 0 || !S_ISREG(about.st_mode)) return std::nullopt;
    return state_of(about);
}

FilesRead::FilesRead() {
    const std::scoped_lock lock(noting);
    noting_now.push_back(this);
}

FilesRead::~FilesRead() {
    const std::scoped_lock lock(noting);
    std::erase(noting_now, this);
}

void FilesRead::note(const fs::path& file, const FileState& state) {
    const std::scoped_lock lock(noting);
    if (noting_now.empty()) return;
    std::error_code error;
    const fs::path whole = fs::absolute(file, error).lexically_normal();
    for (FilesRead* const one : noting_now) one->all_.emplace(error ? file : whole, state);
}

}  // namespace grainreel
