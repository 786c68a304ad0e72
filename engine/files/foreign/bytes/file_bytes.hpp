// An ordinary file, read at any place. It is read into memory and not mapped: a file that another program
// truncates while it is read must end in a message, and a mapped one ends in a signal.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace grainreel {

// Which file lies under a name, and how it was when somebody looked.
struct FileState {
    std::uint64_t size = 0;
    std::uint64_t device = 0, inode = 0;
    std::int64_t changed = 0;  // ns since 1970, of its content

    bool same_file(const FileState& other) const { return device == other.device && inode == other.inode; }
    bool operator==(const FileState&) const = default;
};

class FileBytes {
  public:
    // Throws UserError where there is no ordinary file or where it cannot be opened.
    explicit FileBytes(const std::filesystem::path& file);
    ~FileBytes();
    FileBytes(const FileBytes&) = delete;
    FileBytes& operator=(const FileBytes&) = delete;

    const std::filesystem::path& path() const { return path_; }
    FileState state() const;
    // Up to `size` bytes from a place on; fewer only at the end of the file. Throws UserError where the disk
    // fails.
    std::size_t read_at(std::uint64_t place, char* to, std::size_t size) const;

  private:
    std::filesystem::path path_;
    int file_ = -1;
};

// The path as a message shows it.
std::string shown(const std::filesystem::path& file);

}  // namespace grainreel
