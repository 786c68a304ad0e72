// Locks a folder that a process fills. The lock is on the file .lock in it, which says who has it. The system
// drops the lock when the process ends, however that happens; a file left behind means nothing.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace grainreel {

class FolderLock {
  public:
    // Takes the lock of an existing folder; none when another process has it. Where the file cannot be made
    // or the file system has no locks, the folder is taken without a lock. command: shown to other processes.
    // Throws UserError where a link or something else has the file's name.
    static std::optional<FolderLock> take(const std::filesystem::path& folder, const std::string& command);
    // The process that has the lock: "process 4711, which began 2031-05-04T12:30:00Z (grainreel movie ...)";
    // none when nobody has it.
    static std::optional<std::string> holder(const std::filesystem::path& folder);

    ~FolderLock();
    FolderLock(FolderLock&& other) noexcept;
    FolderLock& operator=(FolderLock&&) = delete;

    const std::filesystem::path& folder() const { return folder_; }
    void renamed(const std::filesystem::path& folder) { folder_ = folder; }
    // Whether the folder with that name is still the one that was locked.
    bool is_there() const;
    // Throws RunError when it is not, and says whether it was removed, renamed or replaced.
    void check_there() const;
    // Takes the folder's new name if it was renamed. False when it is gone; nothing may be written under its
    // old name then.
    bool follow();

  private:
    std::optional<std::filesystem::path> place() const;  // absolute path of the folder of the locked file
    FolderLock(std::filesystem::path folder, int file) : folder_(std::move(folder)), file_(file) {}

    std::filesystem::path folder_;
    int file_ = -1;  // descriptor; -1 without a lock
};

}  // namespace grainreel
