#include "engine/base/plain_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace grainreel {

namespace fs = std::filesystem;

namespace {

constexpr mode_t for_all = 0666;

// Takes an open file that is an ordinary one. O_NONBLOCK kept the opening from waiting; here it means
// nothing.
int if_plain(int file) {
    struct stat about {};
    if (file < 0 || (::fstat(file, &about) == 0 && S_ISREG(about.st_mode))) return file;
    ::close(file);
    errno = EINVAL;
    return -1;
}

bool is_device(const fs::path& path) {
    return other_than_file(path, false) == "a device";
}

}  // namespace

std::string other_than_file(const fs::path& path, bool behind_links) {
    std::error_code ignored;
    switch ((behind_links ? fs::status(path, ignored) : fs::symlink_status(path, ignored)).type()) {
        case fs::file_type::directory:
            return "a folder";
        case fs::file_type::symlink:
            return "a link";
        case fs::file_type::fifo:
            return "a pipe";
        case fs::file_type::socket:
            return "a socket";
        case fs::file_type::block:
        case fs::file_type::character:
            return "a device";
        default:
            return "";
    }
}

bool is_plain(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

std::ifstream read_plain(const fs::path& path) {
    std::ifstream file;
    if (is_plain(path))
        file.open(path, std::ios::binary);
    else
        file.setstate(std::ios::failbit);
    return file;
}

int open_plain(const fs::path& path, int flags) {
    if ((flags & O_ACCMODE) == O_RDONLY) flags |= O_WRONLY;
    return if_plain(::open(path.c_str(), flags | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
}

int make_plain(const fs::path& path) {
    if (is_device(path)) return ::open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC);
    make_way(path);
    return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, for_all);
}

void make_way(const fs::path& path) {
    // Fails for a folder; who makes the file then says so.
    if (!is_device(path)) ::unlink(path.c_str());
}

std::error_code make_plain_folder(const fs::path& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (!error && fs::symlink_status(path, error).type() != fs::file_type::directory && !error)
        error = std::make_error_code(std::errc::not_a_directory);
    return error;
}

}  // namespace grainreel
