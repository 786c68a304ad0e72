// The frames of one or many files as one list by rising step or time. Files that several processes wrote of
// one step are one frame; of a step that a file or its successor has twice the later one counts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/frames/frame_archive.hpp"

namespace grainreel {

class RawSeries {
  public:
    // All files must be of one format. Throws UserError where one cannot be read.
    explicit RawSeries(std::vector<std::filesystem::path> files);

    const RawFacts& facts() const { return facts_; }
    const std::vector<std::filesystem::path>& files() const { return files_; }
    // By rising step, else by time, else in the order of the files.
    const std::vector<RawMoment>& moments() const { return moments_; }
    // With the rows of all files that have this moment. Throws as RawFile::read.
    RawFrame read(std::size_t index) const;
    // "run.dump: frame 3", for messages.
    std::string place(std::size_t index) const;
    std::vector<std::string> news() const { return news_; }

  private:
    struct Part {
        std::size_t file, frame;
    };
    // Opens a file, or takes the one that was opened last.
    RawFile& opened(std::size_t file) const;
    void list_moments();
    void join_equal_steps(std::vector<std::pair<RawMoment, Part>>& all);

    std::vector<std::filesystem::path> files_;
    const RawFormat* format_ = nullptr;
    RawFacts facts_;
    std::vector<RawMoment> moments_;
    std::vector<std::vector<Part>> parts_;  // of each moment
    std::vector<std::string> news_;
    // One file at a time is kept open: there may be thousands.
    mutable std::size_t open_file_ = 0;
    mutable std::unique_ptr<RawFile> open_;
};

// Which files belong together: one file, a numbered series, what a pattern names, or all of a folder.

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
