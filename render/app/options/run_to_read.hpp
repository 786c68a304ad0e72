// Runs as verbs take them: a run's folder of ours, or files of other programs, which are imported first.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/files/frames/frame_archive.hpp"
#include "render/app/messages/reporter.hpp"

namespace grainreel {

// --columns, --radius, --time-step, --units, --species, --density, --contacts, --walls, --walls-scale,
// --container,
// --moves-with and --one.
void add_reading(CLI::App& verb, ReadingOptions& reading);
// The name of an option of these that was given; empty for none.
std::string given_reading(const ReadingOptions& reading);

struct RunToRead {
    std::filesystem::path folder;  // of a run, with scene.toml
    std::filesystem::path beside;  // where what is made of it goes: the folder of the files, or of the run
    bool imported = false;
};

// The folder that a file, a pattern or a folder lies in.
std::filesystem::path folder_around(const std::filesystem::path& path);

// Tells what was guessed and derived. Throws UserError for options of reading with a run of ours.
RunToRead run_to_read(const std::filesystem::path& path, const ReadingOptions& reading, Reporter& reporter);

}  // namespace grainreel
