#include "engine/base/text_file.hpp"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"

namespace grainreel {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
    throw RunError(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(error)));
}

}  // namespace

TextFile::TextFile(const std::filesystem::path& path) : path_(path), file_(std::fopen(path.c_str(), "w")) {
    if (!file_) fail(path, errno);
}

TextFile::TextFile(const std::filesystem::path& path, std::uintmax_t bytes)
    : path_(path), file_(std::fopen(path.c_str(), "a")) {
    if (!file_) fail(path, errno);
    std::error_code error;
    std::filesystem::resize_file(path, bytes, error);
    if (error) fail(path, error.value());
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
