// The runs that verbs read: a folder of a run of ours, or files of other programs, which are imported first.
#pragma once

#include <filesystem>
#include <string>

#include "engine/files/frames/state_archive.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/options/cli.hpp"

namespace grainreel {

// --columns, --radius, --time-step, --units, --species, --density, --contacts, --walls, --walls-scale,
// --container, --moves-with and --one.
void add_reading(CLI::App& verb, ReadingOptions& reading);
// The name of one of these options that was given; empty for none.
std::string given_reading(const ReadingOptions& reading);
// Throws UserError where one of them is given and the path has no files of other programs: because nothing is
// there, because the file is in no format that is read, or because it is a run of ours.
void check_reading(const std::filesystem::path& path, const ReadingOptions& reading);

struct RunToRead {
    std::filesystem::path folder;  // folder of a run, with scene.toml
    // The folder in which results are put: that of the imported files, or that around the run.
    std::filesystem::path beside;
    bool imported = false;
    std::vector<std::string> news{};  // what was told of imported files
};

// The folder that a file, a pattern or a folder lies in. Unlike folder_around(), it knows patterns and
// folders.
std::filesystem::path folder_holding(const std::filesystem::path& path);

// If the folder was written by `grainreel handover` and another engine has run in it, makes our run's files
// there from that engine's dump, unless they are there already. Warns if that engine's run is not complete.
// Throws as bring_back() does.
void bring_back_to_read(const std::filesystem::path& path, Reporter& reporter);

// Throws UserError for a folder that is none of a run, but has a folder inside with files of another program.
void refuse_other_folder(const std::filesystem::path& path);

// Finds the run, or imports the files and tells what was guessed and derived. Throws UserError when options
// of add_reading() are given with a run of ours.
RunToRead run_to_read(const std::filesystem::path& path, const ReadingOptions& reading, Reporter& reporter);

}  // namespace grainreel
