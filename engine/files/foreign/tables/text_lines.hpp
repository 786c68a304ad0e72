// The lines of a text file, behind gzip and zstd too, with their numbers and places.
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

    // To the next line. False at the end of the file.
    bool next();
    // The same, past lines of blanks.
    bool next_filled();
    // Takes the line back: next() gives it once more. The line is then the one before, without its text.
    void put_back() { go_to(begin_, number_ - 1); }
    // Without its end ("\n", "\r\n"); the mark of UTF-8 before the first line is left out. Stands until the
    // next call.
    std::string_view text() const { return text_; }
    std::uint64_t number() const { return number_; }  // from 1
    std::uint64_t begin() const { return begin_; }    // byte of the unpacked content
    bool ended() const { return ended_; }             // whether the line has an end
    std::uint64_t next_begin() const { return place_ + at_; }
    bool cut_off() const { return source_->cut_off(); }

    // The next line is then the one that begins at `byte`, with `lines` lines before it.
    void go_to(std::uint64_t byte, std::uint64_t lines);

    const std::filesystem::path& file() const { return file_; }
    // Throws UserError "FILE:LINE: what" for the present line.
    [[noreturn]] void fault(const std::string& what) const;

  private:
    bool fill();

    std::filesystem::path file_;
    std::unique_ptr<ByteSource> source_;
    std::vector<char> buffer_;
    std::size_t at_ = 0, filled_ = 0;  // of the buffer
    std::uint64_t place_ = 0;          // byte of the file where the buffer begins
    std::string_view text_;
    std::uint64_t number_ = 0, begin_ = 0;
    bool ended_ = true;
};

// The lines that lie whole in the first bytes of a file, `most` at most, and blank ones left out; how a file
// is known by its content.
std::vector<std::string_view> lines_of(const FileHead& head, std::size_t most);

// A text file of frames one behind the other. It is read over once to find where each frame begins; a format
// says how one frame is passed over and how it is read.

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
