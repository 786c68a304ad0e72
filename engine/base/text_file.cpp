#include "engine/base/text_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"

namespace grainreel {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
    // Another reason than a full disk or missing rights.
    const bool refused = error == EINVAL || error == EEXIST || error == ELOOP || error == ENXIO;
    const std::string other = refused ? other_than_file(path, false) : "";
    const std::string why = other.empty() ? std::strerror(error) : "it is " + other;
    errno = error;  // for replace_file()
    throw RunError(fmt::format("{}: cannot be written: {}", path.string(), why));
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
