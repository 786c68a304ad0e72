// Reading and writing files safely, in folders that may come from somebody else. Only ordinary files are
// read: a pipe may never deliver anything, and a device has no end. Nothing is written through a link, which
// may lead to any file. Files are to be opened by these functions. (A few places open files themselves, such
// as FileBytes and some files of engine/handover.) TextFile and replace_file() report every failed write.
#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

namespace grainreel {

// What is at the path if it is not an ordinary file: "a folder", "a pipe", "a link", ...; empty for an
// ordinary file and where there is nothing. behind_links: whether links are followed.
std::string other_than_file(const std::filesystem::path& path, bool behind_links);

// Whether anything, a folder, or an ordinary file has that name, perhaps through a link. What cannot be
// looked at counts as nothing.
bool is_there(const std::filesystem::path& path);
bool is_folder(const std::filesystem::path& path);
bool is_plain(const std::filesystem::path& path);

// The folder that a file is in; "." where its path names none.
std::filesystem::path folder_around(const std::filesystem::path& file);
// Throws UserError where a file cannot be made because that folder is not there. name: the file as the user
// gave it, "--out film.mp4".
void check_folder_around(const std::filesystem::path& file, const std::string& name);

// Opens an ordinary file for reading. Where there is none, the stream has failed from the start.
std::ifstream read_plain(const std::filesystem::path& path);

// Opens an existing ordinary file, not a link, for writing. flags: further flags of open(2). Returns a
// descriptor, or -1 with errno.
int open_plain(const std::filesystem::path& path, int flags = 0);

// Makes a new, empty file in place of whatever is at the path. A link is removed, not followed. A device
// (/dev/full) stays and is opened. Returns a descriptor, or -1 with errno.
int make_plain(const std::filesystem::path& path);

// Removes what is at the path, unless it is a folder or a device. It is called before a library makes a file
// there.
void make_way(const std::filesystem::path& path);

// Makes a folder, or accepts one that exists. A link to a folder is an error.
std::error_code make_plain_folder(const std::filesystem::path& path);

// A text file that is written piece by piece. Each write reaches the system before it returns, and a failed
// one (a full disk) is a RunError that names the file and the reason.
class TextFile {
  public:
    // Makes the file in place of whatever is at the path; a link is not followed. Throws RunError on failure.
    explicit TextFile(const std::filesystem::path& path);
    // Continues an existing file after its first `bytes`; the rest is cut off. Throws RunError as above, and
    // where the file is a link.
    TextFile(const std::filesystem::path& path, std::uintmax_t bytes);

    // Throws RunError when the text could not be written completely.
    void write(std::string_view text);

    const std::filesystem::path& path() const { return path_; }

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Close> file_;
};

// Replaces the content of a file by `text`. Readers see the old file or the new one, never a part. Throws
// RunError when it cannot be written; the old file stays then.
void replace_file(const std::filesystem::path& path, std::string_view text);

}  // namespace grainreel
