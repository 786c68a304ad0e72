// A folder that a process fills: a lock on the file .lock in it, which says who that is. The system drops the
// lock when the process ends, however that happens; a file that is left behind means nothing.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace grainreel {

class FolderLock {
  public:
    // Takes the lock of a folder that is there; none when somebody else has it. Where the file cannot be
    // made, or the file system knows no locks, the folder is taken without one. `command`: told to others.
    // Throws UserError where a link or something else has the file's name.
    static std::optional<FolderLock> take(const std::filesystem::path& folder, const std::string& command);
    // Who has the folder's lock: "process 4711, which began 2031-05-04T12:30:00Z (grainreel movie ...)"; none
    // when nobody has it.
    static std::optional<std::string> holder(const std::filesystem::path& folder);

    ~FolderLock();
    FolderLock(FolderLock&& other) noexcept;
    FolderLock& operator=(FolderLock&&) = delete;

    const std::filesystem::path& folder() const { return folder_; }
    void renamed(const std::filesystem::path& folder) { folder_ = folder; }
    // Whether the folder of that name is the one that was locked.
    bool is_there() const;
    // Throws RunError when it is not, and says what became of it: it was removed, renamed or replaced.
    void check_there() const;
    // Takes the name that the folder has now. False when it is gone: nothing may be written under its name
    // then.
    bool follow();

  private:
    std::optional<std::filesystem::path> place() const;  // of the locked file's folder, absolute
    FolderLock(std::filesystem::path folder, int file) : folder_(std::move(folder)), file_(file) {}

    std::filesystem::path folder_;
    int file_ = -1;  // descriptor; -1 without a lock
};

}  // namespace grainreel
