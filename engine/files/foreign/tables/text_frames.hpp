// A text file of frames one behind the other. It is read over once to find where each frame begins; a format
// says how one frame is passed over and how it is read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/foreign/tables/text_lines.hpp"

namespace grainreel {

class TextFrames : public RawFile {
  public:
    const RawFacts& facts() const override { return facts_; }
    const std::vector<RawMoment>& moments() const override { return moments_; }
    RawFrame read(std::size_t index) const override;
    std::vector<std::string> news() const override { return news_; }
    bool grow() override;

  protected:
    enum class Passed { frame, end, cut };

    explicit TextFrames(const std::filesystem::path& file);

    // Reads over one frame and says of which moment it is. `end`: nothing but blank lines is left; `cut`: the
    // file ends within the frame. Throws UserError where the file cannot be followed.
    virtual Passed pass_over(TextLines& lines, RawMoment& moment) = 0;
    // One that was passed over.
    virtual RawFrame read_frame(TextLines& lines, const RawMoment& moment) const = 0;

    // Finds all frames; called by who makes the reader, once it is whole. Throws UserError when there is
    // none.
    void find_frames();
    template <class Reader>
    friend std::unique_ptr<RawFile> open_text_frames(const std::filesystem::path& file);

    RawFacts facts_;

  private:
    struct Place {
        std::uint64_t byte = 0, lines = 0;  // lines before it
    };
    struct Seen {
        std::uint64_t size = 0, file = 0;  // bytes; number of the inode
    };

    Seen look() const;
    void go_on(bool growing);
    void leave_out(const TextLines& lines);

    std::filesystem::path file_;
    std::vector<RawMoment> moments_;
    std::vector<Place> places_;
    Place next_;             // where the next frame begins
    bool open_end_ = false;  // the last line of the last frame has no end
    std::vector<std::string> news_;
    Seen seen_;
    mutable std::mutex reading_;
    mutable TextLines lines_;
};

template <class Reader>
std::unique_ptr<RawFile> open_text_frames(const std::filesystem::path& file) {
    auto reader = std::make_unique<Reader>(file);
    static_cast<TextFrames&>(*reader).find_frames();
    return reader;
}

}  // namespace grainreel
