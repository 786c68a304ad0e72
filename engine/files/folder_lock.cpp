#include "engine/files/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/run_json.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

constexpr const char* lock_name = ".lock";

std::string host_name() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

// Whether the file with that name is the open file.
bool is_same_file(int file, const fs::path& path) {
    struct stat open {
    }, named{};
    return ::fstat(file, &open) == 0 && ::stat(path.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
           open.st_ino == named.st_ino;
}

// The absolute `path`, made relative to the working folder if the path that the user gave is relative.
fs::path as_given(const fs::path& path, const fs::path& given) {
    std::error_code error;
    return given.is_absolute() ? path : fs::proximate(path, error);
}

bool lock(int file, int kind) {
    while (::flock(file, kind | LOCK_NB) != 0) {
        if (errno == EWOULDBLOCK) return false;
        if (errno != EINTR) return true;  // the file system has no locks
    }
    return true;
}

// Tries several times, because a process that only looks at the lock holds it for a moment.
bool lock_patiently(int file) {
    constexpr int attempts = 5;
    for (int i = 1; i < attempts; ++i) {
        if (lock(file, LOCK_EX)) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return lock(file, LOCK_EX);
}

void write_holder(int file, const std::string& command) {
    const std::string text = fmt::format("{}\n{}\n{}\n{}\n", ::getpid(), host_name(), utc_now(), command);
    if (::ftruncate(file, 0) != 0) return;
    // The text is only for messages.
    [[maybe_unused]] const ssize_t ignored = ::pwrite(file, text.data(), text.size(), 0);
}

std::string read_holder(const fs::path& path) {
    std::ifstream file = read_plain(path);
    std::string process, host, since, command;
    std::getline(file, process), std::getline(file, host), std::getline(file, since);
    std::getline(file, command);
    if (process.empty()) return "another process";
    std::string text = "process " + process;
    if (host != host_name()) text += " on " + host;
    text += ", which began " + since;
    return command.empty() ? text : text + " (" + command + ")";
}

}  // namespace

std::optional<FolderLock> FolderLock::take(const fs::path& folder, const std::string& command) {
    const fs::path path = folder / lock_name;
    while (true) {
        if (const std::string other = other_than_file(path, false); !other.empty())
            throw UserError("{}: is {}, not the lock of a run; remove it", path.string(), other);
        const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file < 0) {
            if (holder(folder)) return std::nullopt;  // the file is another user's, and a process has it
            return FolderLock(folder, -1);
        }
        if (!lock_patiently(file)) {
            ::close(file);
            return std::nullopt;
        }
        if (is_same_file(file, path)) {
            write_holder(file, command);
            return FolderLock(folder, file);
        }
        ::close(file);  // the process that had it before has removed the file meanwhile
    }
}

std::optional<std::string> FolderLock::holder(const fs::path& folder) {
    const fs::path path = folder / lock_name;
    if (!is_plain(path)) return std::nullopt;
    const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    if (file < 0) return std::nullopt;
    const bool is_free = lock(file, LOCK_SH);
    ::close(file);
    if (is_free) return std::nullopt;
    return read_holder(path);
}

FolderLock::~FolderLock() {
    if (file_ < 0) return;
    std::error_code ignored;
    // The file is removed before it is closed, so that a process which opens it in between sees that it is
    // gone.
    if (is_same_file(file_, folder_ / lock_name)) fs::remove(folder_ / lock_name, ignored);
    ::close(file_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : folder_(std::move(other.folder_)), file_(std::exchange(other.file_, -1)) {}

bool FolderLock::is_there() const {
    return file_ >= 0 ? is_same_file(file_, folder_ / lock_name) : is_folder(folder_);
}

std::optional<fs::path> FolderLock::place() const {
    if (file_ < 0) return std::nullopt;
    std::error_code error;
    // The path under which the system knows the open file now. For a removed file it does not exist.
    const fs::path file = fs::read_symlink(fmt::format("/proc/self/fd/{}", file_), error);
    if (error || file.filename() != lock_name || !is_same_file(file_, file)) return std::nullopt;
    return file.parent_path();
}

void FolderLock::check_there() const {
    if (is_there()) return;
    const std::string name = folder_.string();
    if (const std::optional<fs::path> now = place())
        throw RunError("{}: the run's folder was renamed to {} while the run went on", name,
                       as_given(*now, folder_).string());
    if (grainreel::is_there(folder_))
        throw RunError(
            "{}: this is no longer the run's folder: it was removed or replaced while the run "
            "went on; nothing more was written there",
            name);
    throw RunError("{}: the run's folder is gone: it was removed or renamed while the run went on", name);
}

bool FolderLock::follow() {
    if (is_there()) return true;
    const std::optional<fs::path> now = place();
    if (now) folder_ = as_given(*now, folder_);
    return now.has_value();
}

}  // namespace grainreel
