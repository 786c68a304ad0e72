// Files in folders that may come from somebody else. Only ordinary files are read: a pipe would be waited for
// without an end, and a device has none. Nothing is written through a link, which may lead to any file.
#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

namespace grainreel {

// What has that name: "a folder", "a pipe", "a link", ...; empty for an ordinary file, and where nothing has
// it. `behind_links`: what a link leads to counts, not the link.
std::string other_than_file(const std::filesystem::path& path, bool behind_links);

// Whether an ordinary file can be reached by that name.
bool is_plain(const std::filesystem::path& path);

// Reads an ordinary file. The stream has failed from the start where there is none.
std::ifstream read_plain(const std::filesystem::path& path);

// An ordinary file that is there and is no link, for writing. flags: more of open(2). Returns a descriptor,
// or -1 with errno.
int open_plain(const std::filesystem::path& path, int flags = 0);

// A new, empty file in the place of what had the name. Of a link only the link goes. A device (/dev/full)
// stays and is opened. Returns a descriptor, or -1 with errno.
int make_plain(const std::filesystem::path& path);

// For libraries that open a file by its name: removes what has the name, unless it is a folder or a device.
void make_way(const std::filesystem::path& path);

// Makes a folder, or takes the one that is there. A link to a folder is an error.
std::error_code make_plain_folder(const std::filesystem::path& path);

// Text on disk with every failure noticed: a full disk is a RunError that names the file and the reason.

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
