// The folder of one run: its name, what happens to an earlier run with that name, and the copies of mesh
// files in it. Only this class makes, empties or removes folders of runs.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "engine/files/folder_lock.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct FolderRequest {
    std::string name;                       // the scene's name
    std::filesystem::path base = "output";  // where folders without an explicit name go
    std::optional<std::filesystem::path>
        out;                // the wanted folder, new or empty; without it base/name, base/name-2, ...
    bool force = false;     // a run that is in `out` is replaced
    std::string command{};  // shown to other processes that want the folder
    std::shared_ptr<FolderLock> goes_on{};  // the lock of a folder whose run is continued
};

// A RunFolder is made after scene and plan were accepted. An earlier run that will be replaced waits beside
// the new one under a hidden name until the new one is complete. Both folders are locked as long as this
// object lives.
class RunFolder {
  public:
    // Throws UserError when
    //  - `out` is an empty name,
    //  - it is not empty and `force` is not set,
    //  - `force` is set and it holds something other than a run of ours,
    //  - another process fills it or the folder of a panel in it (a panel is one of several runs in a film),
    //  - the folder cannot be made or written.
    explicit RunFolder(const FolderRequest& request);
    // Throws the same errors for `out` and makes nothing: for a command that works for long before it needs
    // the folder.
    static void check(const std::filesystem::path& out, bool force);

    const std::filesystem::path& path() const { return lock_->folder(); }
    const FolderLock& lock() const { return *lock_; }
    // Takes the folder's new name if it was renamed; false when it is gone.
    bool follow() { return lock_->follow(); }

    // The folder in which the run that will be replaced waits; empty when there is none.
    const std::filesystem::path& previous() const { return previous_; }

    // Called when the new run is complete. Removes the previous one, unless somebody has put other files
    // there.
    void remove_previous();

    // Called when the new run never began. Removes its folder, or empties it when it existed before, and puts
    // the previous run back. It leaves alone a folder of that name that somebody else has made, and the
    // folder of a run that should have been continued.
    void discard();

  private:
    void take(const std::filesystem::path& out, bool force);
    void adopt(const std::filesystem::path& path);  // takes an empty folder
    bool make(const std::filesystem::path& path);   // false when something has that name
    void move_aside(const std::filesystem::path& path);
    void put_back(const std::filesystem::path& path);  // puts the previous run back
    using Lock = std::shared_ptr<FolderLock>;
    Lock locked(const std::filesystem::path& path) const;  // throws UserError when another process has it

    std::string command_;
    std::filesystem::path previous_;
    Lock lock_, previous_lock_;
    bool adopted_ = false;  // whether the folder existed before, empty
    bool goes_on_ = false;  // whether it existed before, with a run
};

// Copies each of kept_files() (files of meshes and paths) into the run's folder, unless it is there.
// previous: where the former folder of this name is now, because the scene may name files in it; empty where
// there was none. Throws UserError where a file has changed since it was read, and RunError where it cannot
// be written.
void keep_mesh_files(const Scene& scene, const std::filesystem::path& folder,
                     const std::filesystem::path& previous = {});

// Copies one file and makes the folder for it. Throws as above.
void keep_file(const std::filesystem::path& from, const std::string& hash, const std::filesystem::path& to);

}  // namespace grainreel
