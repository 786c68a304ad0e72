#include "engine/base/plain_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "engine/base/error.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

constexpr mode_t for_all = 0666;

// Returns an open file if it is an ordinary one, else closes it. O_NONBLOCK kept open() from waiting and has
// no meaning for an ordinary file.
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

bool is_there(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

bool is_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

bool is_plain(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

fs::path folder_around(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

void check_folder_around(const fs::path& file, const std::string& name) {
    const fs::path folder = folder_around(file);
    if (!is_folder(folder))
        throw UserError("{}: there is no folder {}; make it first", name, folder.string());
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
    // This fails for a folder; the function that makes the file then reports it.
    if (!is_device(path)) ::unlink(path.c_str());
}

std::error_code make_plain_folder(const fs::path& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (!error && fs::symlink_status(path, error).type() != fs::file_type::directory && !error)
        error = std::make_error_code(std::errc::not_a_directory);
    return error;
}

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
    // Errors that come from what is at the path, not from a full disk or missing rights.
    const bool refused = error == EINVAL || error == EEXIST || error == ELOOP || error == ENXIO;
    const std::string other = refused ? other_than_file(path, false) : "";
    const std::string why = other.empty() ? std::strerror(error) : "it is " + other;
    errno = error;  // for replace_file()
    throw RunError("{}: cannot be written: {}", path.string(), why);
}

std::FILE* stream_of(int file, const char* mode) {
    std::FILE* const stream = file < 0 ? nullptr : ::fdopen(file, mode);
    if (file >= 0 && stream == nullptr) ::close(file);
    return stream;
}

}  // namespace

TextFile::TextFile(const std::filesystem::path& path) : path_(path), file_(stream_of(make_plain(path), "w")) {
    if (!file_) fail(path, errno);
}

TextFile::TextFile(const std::filesystem::path& path, std::uintmax_t bytes)
    : path_(path), file_(stream_of(open_plain(path, O_APPEND), "a")) {
    if (!file_ || ::ftruncate(::fileno(file_.get()), static_cast<off_t>(bytes)) != 0) fail(path, errno);
}

void TextFile::write(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size() ||
        std::fflush(file_.get()) != 0) {
        fail(path_, errno);
    }
}

void replace_file(const std::filesystem::path& path, std::string_view text) {
    const std::filesystem::path part = path.parent_path() / ("." + path.filename().string() + ".part");
    try {
        TextFile(part).write(text);
    } catch (const RunError&) {
        const int error = errno;
        std::error_code ignored;
        std::filesystem::remove(part, ignored);
        fail(path, error);
    }
    std::error_code error;
    std::filesystem::rename(part, path, error);
    if (error) fail(path, error.value());
}

}  // namespace grainreel
