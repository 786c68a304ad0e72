// Turns frames of another program into the folder of a run: scene.toml, trajectory.nc, measures.csv, and
// contacts.nc where contacts are known. After that all commands that show or measure a run work with it.
//
// The copy costs as much disk space as the frames. In return no command needs code of its own for files of
// other programs, any moment is found at once, and damaged frames are found before the first picture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/files/frames/state_archive.hpp"

namespace grainreel {

struct ImportRequest {
    std::filesystem::path from;  // a file, a pattern or a folder
    ReadingOptions reading{};
    std::filesystem::path folder;  // the folder to make, which must not exist
    std::string program_version{};
    // Called with the share that is done. If it returns false, import_run() throws RunError and leaves
    // nothing.
    std::function<bool(double)> watcher{};
};

struct Imported {
    std::filesystem::path folder;
    std::int64_t frames = 0, most_grains = 0;
    std::vector<std::string> news;  // what was guessed, left out or derived, a line for each
};

// Throws UserError for what is wrong with the files, and RunError where the folder cannot be written. Nothing
// unfinished is left.
Imported import_run(const ImportRequest& request);

// The same in the user's cache folder ($XDG_CACHE_HOME/grainreel/imports), where a later call with the same
// files (by name, size, times and inode, also those that a list names), options and program version finds it
// again. An import that was damaged or changed since is made anew. If all imports together exceed 4 GB, those
// are removed that were not used for the longest time. Without a cache folder that is the user's alone
// (own_folder.hpp), or where that is full, the import is made in the temporary folder. Throws UserError where
// a link or somebody else has taken the name there.
Imported cached_import(ImportRequest request);

// A message in which the folder of an import has the name of the files that it was made of, which the user
// knows: "bed.dump: trajectory.nc: frame 3 ...".
std::string named_as(std::string text, const std::filesystem::path& folder,
                     const std::filesystem::path& from);

// What is in that folder.
struct ImportsKept {
    std::filesystem::path folder;
    std::size_t imports = 0;
    std::uintmax_t bytes = 0, most_bytes = 0;  // size of all imports together, and its limit
    std::string fault{};  // why nothing is imported there, in words; empty if all is well
};
ImportsKept imports_kept();

}  // namespace grainreel
