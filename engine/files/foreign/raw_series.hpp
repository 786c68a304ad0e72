// The frames of several files by rising step or time (moment_order.hpp). Files that several processes wrote
// for the same step are one frame. If a step comes twice because a run was continued, the later one counts.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/system/file_state.hpp"
#include "engine/files/foreign/moment_order.hpp"
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
    using Parts = std::vector<PlacedMoment>;
    // A file as it was when it was looked at.
    struct Looked {
        FileState state;
        std::vector<RawMoment> moments;
    };
    // Opens a file, unless it is open. The file stays open until the next call at least.
    RawFile& opened(const std::filesystem::path& file) const;
    Looked look(const std::filesystem::path& file) const;
    void list_moments();
    void tell_of_return(const OrderedMoments::GoneBack& gone_back);
    bool are_parts(const PlacedMoment& one, const PlacedMoment& other) const;
    void tell_of_equal_files();

    std::vector<std::filesystem::path> files_;
    std::vector<Looked> looked_;  // one for each file
    const RawFormat* format_ = nullptr;
    RawFacts facts_;
    std::vector<RawMoment> moments_;
    std::vector<Parts> parts_;  // for each moment: the frames that it is made of
    std::vector<std::string> news_;
    // The files that are open; the last one was used last. Files with one frame are closed for the next,
    // because there may be thousands.
    mutable std::vector<std::pair<std::filesystem::path, std::unique_ptr<RawFile>>> open_;
};

}  // namespace grainreel
