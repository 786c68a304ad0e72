// Lines of a text behind any packing, with their places, through a buffer of fixed size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/byte_source.hpp"
#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

struct TextLine {
    std::string_view text;    // without its end; valid until the next call
    std::uint64_t place = 0;  // of its first byte in the unpacked content
    std::int64_t number = 0;  // from 1
    bool ended = false;       // whether a line feed stands behind it
};

class LineReader {
  public:
    explicit LineReader(const std::filesystem::path& file);

    // Returns false at the end of the content. Throws UserError where a line is longer than any of a dump.
    bool next(TextLine& line);
    // The same, with lines passed over in which there are only blanks.
    bool next_with_words(TextLine& line);
    // The line that next() gave will be given once more.
    void back(const TextLine& line);

    // Lines as one piece of text, at least one, the last of them with its line feed (which is put there where
    // the content ends without one). Behind it are 64 bytes more. Empty at the end of the content.
    std::string_view lines();
    // Whether what lines() gave last is a line that ends with the content, without a line feed.
    bool unended() const { return unended_; }
    // Says that so many bytes and lines of what lines() gave were read.
    void take(std::size_t bytes, std::int64_t lines);

    // Where the next line begins.
    std::uint64_t place() const { return buffer_place_ + used_; }
    std::int64_t number() const { return number_; }
    void seek(std::uint64_t place, std::int64_t number);

    // Whether the packed stream ended before its end; known once the end was reached.
    bool cut_off() const { return source_->cut_off(); }

  private:
    // More of the content behind what was not read yet. Returns false at the end.
    bool fill();

    std::filesystem::path file_;
    std::unique_ptr<ByteSource> source_;
    std::vector<char> buffer_;
    std::uint64_t buffer_place_ = 0;  // of its first byte
    std::size_t used_ = 0, held_ = 0;
    bool at_end_ = false, unended_ = false;
    std::int64_t number_ = 1;
};

// The rows of a frame of a text dump, as numbers. This is where the time goes that reading takes.

struct RowsToRead {
    std::vector<std::string> names;  // of the columns
    std::int64_t rows = 0;
    std::uint64_t bytes = 0;  // of all rows together, at most; bounds the memory that is asked for
    bool pairs = false;       // no grains: nothing is known of what the columns mean
};

// From where `lines` stands. Throws UserError with the line of a row that has too few or too many fields,
// that has a word where a number must be, or an id, a place or a radius that is no finite number.
RawTable read_rows(LineReader& lines, const std::filesystem::path& file, const RowsToRead& wanted);

}  // namespace grainreel
