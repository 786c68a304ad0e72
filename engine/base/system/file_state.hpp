// What tells whether a file is still the one that was read. FilesRead notes the states of all files that are
// read while something is made of them, so that a cache can make it anew when one of them has changed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>

struct stat;

namespace grainreel {

// Identity, size and times of a file at the moment when it was looked at.
struct FileState {
    std::uint64_t size = 0;
    std::uint64_t device = 0, inode = 0;
    std::int64_t changed = 0;  // ns since 1970, the last change of its content; programs may set it (touch)
    std::int64_t touched = 0;  // ns since 1970, the last change of anything; only the system sets it

    bool same_file(const FileState& other) const { return device == other.device && inode == other.inode; }
    bool operator==(const FileState&) const = default;
};

FileState state_of(const struct stat& about);
// None where there is no ordinary file, perhaps behind a link.
std::optional<FileState> state_of_file(const std::filesystem::path& file);

// The files that are read, by any thread, while this object lives.
class FilesRead {
  public:
    FilesRead();
    ~FilesRead();
    FilesRead(const FilesRead&) = delete;
    FilesRead& operator=(const FilesRead&) = delete;

    // By absolute path; the state is that of the first time when the file was opened.
    const std::map<std::filesystem::path, FileState>& all() const { return all_; }

    // Readers call this for each file that they open.
    static void note(const std::filesystem::path& file, const FileState& state);

  private:
    std::map<std::filesystem::path, FileState> all_;
};

}  // namespace grainreel
