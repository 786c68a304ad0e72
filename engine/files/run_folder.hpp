// The folder of one run: its name, and what happens to a run that is already there.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "engine/files/folder_lock.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct RunFolderRequest {
    std::string name;                       // of the scene
    std::filesystem::path base = "output";  // where folders without an explicit name go
    std::optional<std::filesystem::path>
        out;                // the wanted folder, new or empty; without it base/name, base/name-2, ...
    bool force = false;     // an `out` that holds a run is replaced
    std::string command{};  // told to others who want the folder
    std::shared_ptr<FolderLock> goes_on{};  // of a run's folder, whose run goes on
};

// Made when scene and plan are accepted, not before. An earlier run that is to be replaced waits beside the
// new one under a hidden name until the new one is complete. Both are locked as long as this lives.
class RunFolder {
  public:
    // Throws UserError when `out` is an empty name, when it exists, is not empty and `force` is not set, when
    // `force` is set and it holds no run of ours or files that are not ours, when another process fills it or
    // a panel's folder in it, and when the folder cannot be made or written.
    explicit RunFolder(const RunFolderRequest& request);

    const std::filesystem::path& path() const { return lock_->folder(); }
    const FolderLock& lock() const { return *lock_; }
    // Takes the name that the folder has now; false when it is gone.
    bool follow() { return lock_->follow(); }

    // Where the run that is being replaced waits; empty when there is none.
    const std::filesystem::path& previous() const { return previous_; }

    // The new run is complete: the previous one is removed, unless it has got files that are not ours.
    void remove_previous();

    // The new run never began: its folder is removed, or emptied when it was there before, and the previous
    // run is put back. A folder of that name that somebody else has put there is left alone, and so is that
    // of a run that was to go on.
    void discard();

  private:
    void take(const std::filesystem::path& out, bool force);
    void adopt(const std::filesystem::path& path);  // an empty folder
    bool make(const std::filesystem::path& path);   // false when something of that name exists
    void move_aside(const std::filesystem::path& path);
    void put_back(const std::filesystem::path& path);  // the previous run
    using Lock = std::shared_ptr<FolderLock>;
    Lock locked(const std::filesystem::path& path) const;  // UserError when another process has it

    std::string command_;
    std::filesystem::path previous_;
    Lock lock_, previous_lock_;
    bool adopted_ = false;  // the folder was there before, empty
    bool goes_on_ = false;  // it was there before, with a run
};

// Copies of the files of meshes and paths in the folder of a run.

// Puts each of kept_files() into the run's folder, unless it is there. previous: where the folder that had
// this name before is now, for files that lie in there; empty: there was none. Throws UserError where a file
// is no longer what was read of it, and RunError where it cannot be written.
void keep_mesh_files(const Scene& scene, const std::filesystem::path& folder,
                     const std::filesystem::path& previous = {});

// One file to a place of that name, whose folder is made. Throws as above.
void keep_file(const std::filesystem::path& from, const std::string& hash, const std::filesystem::path& to);

}  // namespace grainreel
