// TextFrames is the base of readers of text files in which frames follow each other. A derived class says how
// one frame is skipped and how it is read. (Dumps have a reader of their own, dumps/text_rows.hpp.)
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/bytes/line_reader.hpp"
#include "engine/files/foreign/dumps/index_file.hpp"
#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

// At most `most` whole lines from the first bytes of a file, without blank lines. A format is recognised by
// them.
std::vector<std::string_view> lines_of(const FileStart& head, std::size_t most);

// A text file in which frames follow each other. One pass over the file finds where each frame begins.
class TextFrames : public RawFile {
  public:
    RawFrame read(std::size_t index) const override;
    bool grow() override;
    bool grows() const override { return true; }

  protected:
    enum class Passed { frame, end, cut };

    explicit TextFrames(const std::filesystem::path& file);

    // Skips one frame and sets its moment; `line` is then the last line that belongs to it. Returns `end` if
    // only blank lines are left, and `cut` if the file ends within the frame. Throws UserError where the file
    // makes no sense.
    virtual Passed pass_over(LineReader& lines, TextLine& line, RawMoment& moment) = 0;
    // Reads a frame that pass_over() has found.
    virtual RawFrame read_frame(LineReader& lines, const RawMoment& moment) const = 0;
    // Throws UserError "FILE:LINE: what".
    [[noreturn]] void fault(const TextLine& line, const std::string& what) const;

    // Finds all frames. It is called after the constructor, since it calls virtual functions. Throws
    // UserError when there is no frame.
    void find_frames();
    template <class Reader>
    friend std::unique_ptr<RawFile> open_text_frames(const std::filesystem::path& file);

  private:
    struct Place {
        std::uint64_t byte = 0;
        std::int64_t line = 1;
    };

    void go_on(bool growing);

    std::vector<Place> places_;
    Place next_;             // where the next frame begins
    TextLine line_;          // the last line that was read by go_on()
    bool open_end_ = false;  // the last line of the last frame has no line feed
    Growth growth_;
    mutable std::mutex reading_;
    mutable LineReader lines_;
};

template <class Reader>
std::unique_ptr<RawFile> open_text_frames(const std::filesystem::path& file) {
    auto reader = std::make_unique<Reader>(file);
    static_cast<TextFrames&>(*reader).find_frames();
    return reader;
}

}  // namespace grainreel
