// Reads text files word by word: words with the line in which each stands, and errors that name the place in
// a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace grainreel {

// Lines end with LF, CRLF or CR.
class WordReader {
  public:
    explicit WordReader(std::string_view text) : left_(text) {}

    // The next word, also across line ends; empty at the end of the text.
    std::string_view next();
    // The next word of this line; empty at its end.
    std::string_view next_in_line();
    // The next word as a number of programs; none where it is no number, or at the end. Then the word is
    // next.
    std::optional<double> next_number();
    // Skips blanks and ends of lines. Returns whether a word follows.
    bool has_word();
    // Skips the rest of this line. The next word is then the first word of the next line.
    void skip_line();
    // The line of the last word, or of the next one after has_word().
    std::int64_t line() const { return line_; }
    bool at_end() const { return left_.empty(); }
    std::string_view left() const { return left_; }

  private:
    void end_line();
    std::string_view take_word();

    std::string_view left_;
    std::int64_t line_ = 1;
};

// Whether a word is `lower_case`, ignoring the case of its ASCII letters.
bool same_word(std::string_view word, std::string_view lower_case);

// These throw UserError with the text "file: what", "file:line: what" or "file: byte 84: what".
[[noreturn]] void refuse_file(const std::filesystem::path& file, const std::string& what);
[[noreturn]] void refuse_line(const std::filesystem::path& file, std::int64_t line, const std::string& what);
[[noreturn]] void refuse_byte(const std::filesystem::path& file, std::size_t byte, const std::string& what);

}  // namespace grainreel
