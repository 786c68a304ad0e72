// Finds which files belong together by their names: those of a series differ in one number, and those that
// several processes wrote in two ("d.dump.*.%" and "%" names of LAMMPS).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace grainreel {

struct RawTable;  // engine/files/foreign/raw_file.hpp

// Files whose names differ only in one number, by rising number ("dump.2" before "dump.10"); or in two
// numbers of which one counts processes, the files of one moment together; or a single file.
struct FileGroup {
    std::string pattern;  // "post/dump.*.vtk", or the name of a single file
    std::vector<std::filesystem::path> files;
};

// The last number in a file's name before a suffix of letters: 5000 for "dump.5000.vtk".
std::optional<std::int64_t> number_in_name(const std::filesystem::path& file);

// The series of a file: all files of its folder in its group. If the name has no number, only the file
// itself.
FileGroup series_of(const std::filesystem::path& file);

// All groups of these files, in the order of their patterns. Where two numbers vary, or one that is not the
// last, the first frames of two or three files are read, to see whether a number is the step and another that
// of a process.
std::vector<FileGroup> grouped(const std::vector<std::filesystem::path>& files);

// Whether two frames have a grain with the same id. Without ids they count as the same grains.
bool share_ids(const RawTable& a, const RawTable& b);

// Whether the files are of different runs, and no series: the first two begin with the same moment of the
// same grains.
bool are_different_runs(const FileGroup& group);

// The ordinary files that a pattern (with * ? [...] in the last parts of the path) names. Throws UserError
// where there are none.
std::vector<std::filesystem::path> files_of_pattern(const std::filesystem::path& pattern);
// The ordinary files of a folder without hidden ones.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder);

}  // namespace grainreel
