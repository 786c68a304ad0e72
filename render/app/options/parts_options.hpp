// A film drawn in parts: the options of `render`, and the script by which a cluster draws and joins them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "render/film/sources/film_request.hpp"

namespace grainreel {

// --part, --parts and --slurm. slurm: the number of parts; 0: no script.
void add_parts(CLI::App& verb, std::optional<PartsWanted>& parts, int& slurm);

// A script that submits itself to Slurm twice: as an array that draws a part in each task, and as a job that
// waits for the array and joins its parts. words: the command as typed, its program first; where: the folder
// that it was typed in; film: the file of --out.
std::string slurm_script(const std::vector<std::string>& words, int parts, const std::filesystem::path& where,
                         const std::filesystem::path& film);

}  // namespace grainreel
