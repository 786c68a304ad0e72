// LineReader reads a text file, packed or not, line by line, with the numbers of the lines and their places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "engine/files/foreign/bytes/byte_source.hpp"

namespace grainreel {

struct TextLine {
    std::string_view text;    // without its line end; valid until the reader's next call
    std::uint64_t place = 0;  // its first byte in the unpacked content
    std::int64_t number = 0;  // from 1
    bool ended = false;       // whether it ends with a line feed
};

class LineReader {
  public:
    explicit LineReader(const std::filesystem::path& file);

    // Reads the next line. Returns false at the end of the content, and `line` stays. Throws UserError where
    // a line is longer than any line of data.
    bool next(TextLine& line);
    // The same, but lines with only blanks are skipped.
    bool next_with_words(TextLine& line);
    // Makes next() return its last line once more. This line must be passed here.
    void back(const TextLine& line);

    // One or more whole lines as one piece of text. The last line has a line feed, which is added if the
    // content ends without one. A caller may read up to 64 bytes beyond the text. Empty at the end of the
    // content.
    std::string_view lines();
    // Whether the last piece that lines() returned ends with the content and without a line feed.
    bool unended() const { return unended_; }
    // Tells that so many bytes and lines of the piece from lines() were used.
    void take(std::size_t bytes, std::int64_t lines);

    // Place at which the next line begins.
    std::uint64_t place() const { return buffer_place_ + used_; }
    std::int64_t number() const { return number_; }
    // Goes to the line that begins at `place` and has this number.
    void seek(std::uint64_t place, std::int64_t number);

    // Whether a packed stream ended too early. This is known only after its end was reached.
    bool cut_off() const { return source_->cut_off(); }

  private:
    // Reads more of the content into the buffer. Returns false at the end.
    bool fill();

    std::filesystem::path file_;
    std::unique_ptr<ByteSource> source_;
    std::vector<char> buffer_;
    std::uint64_t buffer_place_ = 0;  // place of the buffer's first byte in the content
    std::size_t used_ = 0, held_ = 0;
    bool at_end_ = false, unended_ = false;
    std::int64_t number_ = 1;
};

}  // namespace grainreel
