// Makes a run's folder of frames that another program wrote: scene.toml, trajectory.nc, contacts.nc where
// contacts are known, measures.csv. From then on everything that draws, asks, compares or reports a run does
// so with it.
//
// The copy costs disk space as large as the frames. In return no verb needs a second way for foreign files,
// any moment is found at once, and the places of damaged or odd frames are found before the first picture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/frames/frame_archive.hpp"

namespace grainreel {

struct ImportRequest {
    std::filesystem::path from;  // a file, a pattern, a folder
    ReadingOptions reading{};
    std::filesystem::path folder;  // that is made; must not be there
    std::string program_version{};
    // Called with the share that is done; false stops, and nothing is left.
    std::function<bool(double)> watcher{};
};

struct ImportedRun {
    std::filesystem::path folder;
    std::int64_t frames = 0, most_grains = 0;
    std::vector<std::string> news;  // what was guessed, left out or derived, a line each
};

// Throws UserError for what is wrong with the files, RunError where the folder cannot be written. Nothing
// half-written stays.
ImportedRun import_run(const ImportRequest& request);

// The same in the user's cache folder ($XDG_CACHE_HOME/grainreel/imports), where a later call with the same
// files and options finds it again: files are known by name, size, time and inode. Imports that were not used
// for longest are removed while all together are larger than 4 GB. Without a cache folder it is made in the
// temporary folder.
ImportedRun cached_import(ImportRequest request);

// What that folder holds.
struct ImportsKept {
    std::filesystem::path folder;
    std::size_t imports = 0;
    std::uintmax_t bytes = 0, most_bytes = 0;  // of all together, and how many are kept
};
ImportsKept imports_kept();

// The scene.toml of an imported run: its species and walls, no contacts and no motion but that of the walls.

// What all frames together say.
struct ImportSurvey {
    Vec3 low{0, 0, 0}, high{0, 0, 0};       // m, of all grains with their radii
    std::vector<double> smallest, largest;  // m, diameters by species; 0 where there are none
    std::vector<std::int64_t> most;         // grains of a species in one frame
    std::int64_t ids = 0;                   // different ids
};

// Writes scene.toml into the folder, and meshes and paths of walls beside it. Throws RunError where that
// cannot be written. news: what was taken for granted.
void write_import_scene(const std::filesystem::path& folder, const ForeignArchive& archive,
                        const ImportSurvey& survey, const ReadingOptions& options,
                        std::vector<std::string>& news);

}  // namespace grainreel
