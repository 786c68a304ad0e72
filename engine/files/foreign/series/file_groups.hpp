// Which files belong together: one file, a numbered series, what a pattern names, or all of a folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/frames/frame_archive.hpp"

namespace grainreel {

// Files whose names differ in one number alone, by rising number ("dump.2" before "dump.10"); or one file.
struct FileGroup {
    std::string pattern;  // "post/dump.*.vtk"; a lone file's own name
    std::vector<std::filesystem::path> files;
};

// The last number in a file's name, before its suffix where that is one of letters: 5000 for "dump.5000.vtk".
std::optional<std::int64_t> number_in_name(const std::filesystem::path& file);

// The series that a file is part of: all files of its folder whose names differ from its own in that number.
// The file alone where its name has no number.
FileGroup series_of(const std::filesystem::path& file);

// All groups of these files, each in the order of its numbers; groups in the order of their patterns.
std::vector<FileGroup> grouped(const std::vector<std::filesystem::path>& files);

// The ordinary files that a pattern names: * ? [...] in the last parts of the path. Throws UserError where
// there are none.
std::vector<std::filesystem::path> files_of_pattern(const std::filesystem::path& pattern);
// The ordinary files of a folder, without hidden ones.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder);

}  // namespace grainreel
