#include "engine/base/system/own_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/system/program.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

constexpr mode_t kOthersWrite = S_IWGRP | S_IWOTH;
constexpr mode_t kPermissions = 07777;

// The fault of an open folder.
std::string fault_of(int folder) {
    struct stat about {};
    if (::fstat(folder, &about) != 0) return std::strerror(errno);
    if (about.st_uid != ::geteuid()) return "belongs to another user";
    if ((about.st_mode & kOthersWrite) == 0) return "";
    // Some file systems have no such rights, and some of these say that the change was made.
    const bool changed = ::fchmod(folder, about.st_mode & kPermissions & ~kOthersWrite) == 0 &&
                         ::fstat(folder, &about) == 0 && (about.st_mode & kOthersWrite) == 0;
    return changed ? "" : "can be written by others";
}

bool is_missing(const fs::path& path) {
    std::error_code ignored;
    return fs::symlink_status(path, ignored).type() == fs::file_type::not_found;
}

}  // namespace

std::string fault_of_own_folder(const fs::path& path) {
    // The folder is opened, so that it is looked at and changed without anything coming in between.
    const int folder = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder < 0) {
        const int error = errno;
        const bool is_other = error == ENOTDIR || error == ELOOP;
        const std::string other = is_other ? other_than_file(path, false) : "";
        return !is_other ? std::strerror(error) : other.empty() ? "is a file" : "is " + other;
    }
    const std::string fault = fault_of(folder);
    ::close(folder);
    return fault;
}

std::string make_own_folder(const fs::path& path) {
    if (::mkdir(path.c_str(), S_IRWXU) != 0 && errno != EEXIST) return std::strerror(errno);
    return fault_of_own_folder(path);
}

fs::path own_cache_folder(const char* name) {
    const fs::path cache = cache_folder();
    if (cache.empty()) return {};
    for (const fs::path& folder : {cache, cache / name})
        if (!is_missing(folder) && !is_own_folder(folder)) return {};
    return cache / name;
}

std::string make_own_cache_folder(const char* name) {
    const fs::path cache = cache_folder();
    if (cache.empty()) return "there is no cache folder";
    std::error_code ignored;
    fs::create_directories(cache.parent_path(), ignored);
    for (const fs::path& folder : {cache, cache / name})
        if (const std::string fault = make_own_folder(folder); !fault.empty())
            return fmt::format("{}: {}", folder.string(), fault);
    return "";
}

bool was_own_folder(const fs::path& path) {
    struct stat about {};
    return ::lstat(path.c_str(), &about) == 0 && S_ISDIR(about.st_mode) && about.st_uid == ::geteuid() &&
           (about.st_mode & kOthersWrite) == 0;
}

bool is_own(const fs::path& path) {
    struct stat about {};
    return ::lstat(path.c_str(), &about) == 0 && about.st_uid == ::geteuid() && !S_ISLNK(about.st_mode);
}

ScratchFolder::ScratchFolder(const std::string& purpose) {
    std::error_code error;
    const fs::path temporary = fs::temp_directory_path(error);
    std::string name = (temporary / ("grainreel-" + purpose + "-XXXXXX")).string();
    if (!error && ::mkdtemp(name.data()) == nullptr) error.assign(errno, std::generic_category());
    if (error)
        throw RunError(
            "{}: no folder for temporary files can be made: {}; set TMPDIR to a folder "
            "of yours",
            temporary.empty() ? "TMPDIR" : temporary.string(), error.message());
    path_ = name;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

}  // namespace grainreel
