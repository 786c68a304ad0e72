// TextLines gives the lines of a text file, packed or not, with their numbers and places. TextFrames is the
// base of readers of text files in which frames follow each other; a derived class says how one frame is
// skipped and how it is read. (Dumps have a faster reader of their own, dumps/text_rows.hpp.)
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/byte_source.hpp"
#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

class TextLines {
  public:
    // Throws UserError when the file cannot be opened.
    explicit TextLines(const std::filesystem::path& file);

    // Goes to the next line. False at the end of the file.
    bool next();
    // The same, but skips lines of blanks.
    bool next_filled();
    // Goes back by one line, so that next() gives this line once more.
    void put_back() { go_to(begin_, number_ - 1); }
    // The line without its end ("\n", "\r\n") and without a byte order mark. Valid until the next call.
    std::string_view text() const { return text_; }
    std::uint64_t number() const { return number_; }  // from 1
    std::uint64_t begin() const { return begin_; }    // its first byte in the unpacked content
    bool ended() const { return ended_; }             // whether the line has a line feed
    std::uint64_t next_begin() const { return place_ + at_; }
    bool cut_off() const { return source_->cut_off(); }

    // Makes the line that begins at `byte`, with `lines` lines before it, the next one.
    void go_to(std::uint64_t byte, std::uint64_t lines);

    const std::filesystem::path& file() const { return file_; }
    // Throws UserError "FILE:LINE: what" with the present line.
    [[noreturn]] void fault(const std::string& what) const;

  private:
    bool fill();

    std::filesystem::path file_;
    std::unique_ptr<ByteSource> source_;
    std::vector<char> buffer_;
    std::size_t at_ = 0, filled_ = 0;  // bytes of the buffer that were used, and that it holds
    std::uint64_t place_ = 0;          // byte of the file where the buffer begins
    std::string_view text_;
    std::uint64_t number_ = 0, begin_ = 0;
    bool ended_ = true;
};

// At most `most` whole lines from the first bytes of a file, without blank lines. A format is recognised by
// them.
std::vector<std::string_view> lines_of(const FileHead& head, std::size_t most);

// A text file in which frames follow each other. One pass over the file finds where each frame begins.
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

    // Skips one frame and sets its moment. Returns `end` if only blank lines are left, and `cut` if the file
    // ends within the frame. Throws UserError where the file makes no sense.
    virtual Passed pass_over(TextLines& lines, RawMoment& moment) = 0;
    // Reads a frame that pass_over() has found.
    virtual RawFrame read_frame(TextLines& lines, const RawMoment& moment) const = 0;

    // Finds all frames. It is called after the constructor, since it calls virtual functions. Throws
    // UserError when there is no frame.
    void find_frames();
    template <class Reader>
    friend std::unique_ptr<RawFile> open_text_frames(const std::filesystem::path& file);

    RawFacts facts_;

  private:
    struct Place {
        std::uint64_t byte = 0, lines = 0;  // its first byte, and the number of lines before it
    };
    struct Seen {
        std::uint64_t size = 0, file = 0;  // in bytes; number of the inode
    };

    Seen look() const;
    void go_on(bool growing);
    void leave_out(const TextLines& lines);

    std::filesystem::path file_;
    std::vector<RawMoment> moments_;
    std::vector<Place> places_;
    Place next_;             // where the next frame begins
    bool open_end_ = false;  // the last line of the last frame has no line feed
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
