// The frames of one or many files as one list by rising step or time. Files that several processes wrote of
// one step are one frame; of a step that a file or its successor has twice the later one counts.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"

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

}  // namespace grainreel
