// Text on disk with every failure noticed: a full disk is a RunError that names the file and the reason.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace grainreel {

// A file written line by line; each write reaches the system before it returns.
class TextFile {
  public:
    // In the place of what had the name; a link is not followed. Throws RunError when the file cannot be
    // made.
    explicit TextFile(const std::filesystem::path& path);
    // Goes on with a file that is there, behind its first `bytes`; what comes after them is cut off.
    // Throws RunError as above, and where the file is a link.
    TextFile(const std::filesystem::path& path, std::uintmax_t bytes);

    // Throws RunError when not all of `text` could be written.
    void write(std::string_view text);

    const std::filesystem::path& path() const { return path_; }

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Close> file_;
};

// Puts `text` in place of what `path` held: readers see the old file or the new one, never a part.
void replace_file(const std::filesystem::path& path, std::string_view text);

}  // namespace grainreel
