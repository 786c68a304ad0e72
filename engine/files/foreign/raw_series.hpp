// Finds which files belong together, and lists their frames by rising step or time. Files that several
// processes wrote for the same step are one frame. If a step comes twice because a run was continued, the
// later one counts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/byte_source.hpp"
#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/frames/state_archive.hpp"

namespace grainreel {

class RawSeries {
  public:
    // All files must have the same format. Throws UserError where one cannot be read.
    explicit RawSeries(std::vector<std::filesystem::path> files);

    // Looks for moments that were written since. files: those of the series by now. Returns whether moments()
    // is another list than before. Throws UserError where a file cannot be read as it is, because it may be
    // half written, and RunError where the first moments are not those of before.
    bool grow(std::vector<std::filesystem::path> files);

    const RawFacts& facts() const { return facts_; }
    const std::vector<std::filesystem::path>& files() const { return files_; }
    // The moments by rising step, or else by time, or else in the order of the files. Only the last one may
    // be open.
    const std::vector<RawMoment>& moments() const { return moments_; }
    // A frame with the rows of all files that have this moment. Throws as RawFile::read does.
    RawFrame read(std::size_t index) const;
    // "run.dump: frame 3", for messages.
    std::string place(std::size_t index) const;
    std::vector<std::string> news() const { return news_; }

  private:
    struct Part {
        std::size_t file, frame;
    };
    // A file as it was when it was looked at.
    struct Looked {
        FileState state;
        std::vector<RawMoment> moments;
    };
    // Opens a file, unless it is the one that was opened last.
    RawFile& opened(const std::filesystem::path& file) const;
    Looked look(const std::filesystem::path& file) const;
    void list_moments();
    void join_equal_steps(std::vector<std::pair<RawMoment, Part>>& all);
    void tell_of_equal_files();

    std::vector<std::filesystem::path> files_;
    std::vector<Looked> looked_;  // one for each file
    const RawFormat* format_ = nullptr;
    RawFacts facts_;
    std::vector<RawMoment> moments_;
    std::vector<std::vector<Part>> parts_;  // for each moment: the frames that it is made of
    std::vector<std::string> news_;
    // Only one file is kept open, because there may be thousands.
    mutable std::filesystem::path open_file_;
    mutable std::unique_ptr<RawFile> open_;
};

// Files whose names differ only in one number, by rising number ("dump.2" before "dump.10"); or a single
// file.
struct FileGroup {
    std::string pattern;  // "post/dump.*.vtk", or the name of a single file
    std::vector<std::filesystem::path> files;
};

// The last number in a file's name before a suffix of letters: 5000 for "dump.5000.vtk".
std::optional<std::int64_t> number_in_name(const std::filesystem::path& file);

// The series of a file: all files of its folder whose names differ only in that number. If the name has no
// number, only the file itself.
FileGroup series_of(const std::filesystem::path& file);

// All groups of these files, in the order of their patterns. Files in a group are in the order of numbers.
std::vector<FileGroup> grouped(const std::vector<std::filesystem::path>& files);

// The ordinary files that a pattern (with * ? [...] in the last parts of the path) names. Throws UserError
// where there are none.
std::vector<std::filesystem::path> files_of_pattern(const std::filesystem::path& pattern);
// The ordinary files of a folder without hidden ones.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder);

}  // namespace grainreel
