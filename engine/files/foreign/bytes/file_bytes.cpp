#include "engine/files/foreign/bytes/file_bytes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"

namespace grainreel {

namespace fs = std::filesystem;

std::string shown(const fs::path& file) {
    constexpr std::size_t most = 400;  // characters
    return excerpt(file.string(), most);
}

FileBytes::FileBytes(const fs::path& file) : path_(file) {
    if (const std::string other = other_than_file(file, true); !other.empty())
        throw UserError(fmt::format("{}: is {}; give an ordinary file", shown(file), other));
    // O_NONBLOCK keeps the opening from waiting where a pipe took the file's name just now.
    file_ = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    struct stat about {};
    if (file_ >= 0 && ::fstat(file_, &about) == 0 && S_ISREG(about.st_mode)) return;
    const std::string why = file_ < 0 ? std::strerror(errno) : "it is no ordinary file";
    if (file_ >= 0) ::close(file_);
    throw UserError(fmt::format("{}: cannot be opened: {}", shown(file), why));
}

FileBytes::~FileBytes() {
    if (file_ >= 0) ::close(file_);
}

FileState FileBytes::state() const {
    struct stat about {};
    if (::fstat(file_, &about) != 0)
        throw UserError(fmt::format("{}: cannot be read: {}", shown(path_), std::strerror(errno)));
    return {static_cast<std::uint64_t>(about.st_size), static_cast<std::uint64_t>(about.st_dev),
            static_cast<std::uint64_t>(about.st_ino),
            std::int64_t{about.st_mtim.tv_sec} * 1000000000 + std::int64_t{about.st_mtim.tv_nsec}};
}

std::size_t FileBytes::read_at(std::uint64_t place, char* to, std::size_t size) const {
    std::size_t done = 0;
    while (done < size) {
        const ssize_t got = ::pread(file_, to + done, size - done, static_cast<off_t>(place + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0)
            throw UserError(fmt::format("{}: cannot be read from byte {} on: {}", shown(path_), place + done,
                                        std::strerror(errno)));
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

}  // namespace grainreel
