// Folders that nobody but the present user can change. What a cache holds is believed, and old parts of it
// are removed. So a cache must not lie in a folder that another user, or a link, has put in its place.
#pragma once

#include <filesystem>
#include <string>

namespace grainreel {

// Why this is no folder of the present user alone, in words ("is a link"); empty if it is one. It must be a
// folder and not a link, and the process's effective user must own it. If others may write in it, that right
// is taken away first.
std::string fault_of_own_folder(const std::filesystem::path& path);

inline bool is_own_folder(const std::filesystem::path& path) {
    return fault_of_own_folder(path).empty();
}

// Makes a folder that only the present user may enter, or takes one that is there. The folders above it must
// exist. Returns the fault, as above; empty if all is well.
std::string make_own_folder(const std::filesystem::path& path);

// The folder of this name in the program's cache folder (program.hpp), which may not exist yet. Empty if the
// user has no cache folder, or if others could change it.
std::filesystem::path own_cache_folder(const char* name);

// Makes that folder if it is not there. Returns what is wrong, with the path; empty if all is well.
std::string make_own_cache_folder(const char* name);

// Whether a folder has been the user's alone so far: as is_own_folder(), but no right is taken away.
bool was_own_folder(const std::filesystem::path& path);

// Whether a path names a file or a folder itself, not a link to one, and the effective user owns it.
bool is_own(const std::filesystem::path& path);

// A folder in the temporary folder that only the present user may enter, with a name that nobody can guess.
// It is removed at the end with all that is in it.
class ScratchFolder {
  public:
    // purpose: a word of its name. Throws RunError where there is no temporary folder that can be written.
    explicit ScratchFolder(const std::string& purpose);
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace grainreel
