// Reads the words and arrays of a legacy VTK file, which is parsed in vtk_legacy.cpp. Words are always text;
// arrays are text or big-endian bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/bytes/content.hpp"
#include "engine/files/foreign/vtk/vtk_numbers.hpp"

namespace grainreel {

class LegacyText {
  public:
    // The content must outlive this object.
    explicit LegacyText(const Content& content) : content_(content) {}

    // Whether arrays from here on are bytes.
    void set_binary(bool binary) { binary_ = binary; }
    bool binary() const { return binary_; }

    // The rest of the line, without its end. Throws UserError for a line of more than 1 MB.
    std::string line();
    // The next word, in this line or a later one; empty at the end of the file. Throws as line() does.
    std::string word();
    // The next word, which word() will give again.
    std::string peek();
    // The next word of this line; empty at its end.
    std::string word_in_line();
    bool at_end();

    // The next word as a count. `what` names it in the message.
    std::uint64_t count(const char* what);
    VtkType type(const char* what);

    // Reads `count` numbers. Those of a binary file begin after the end of this line. `finite` refuses NaN
    // and infinity. Throws UserError where the file has fewer. A count that the file cannot hold is refused
    // before memory is asked for.
    template <class T>
    std::vector<T> numbers(VtkType type, std::uint64_t count, bool finite);
    void skip(VtkType type, std::uint64_t count);
    // Skips words. A text file has one on each line; a binary file has the length before each word.
    void skip_words(std::uint64_t count);
    // Skips the lines after METADATA up to the next empty one or the next keyword.
    void skip_metadata();

    // Throws UserError with the line of the last word, or in a binary file with its byte.
    [[noreturn]] void refuse(const std::string& what) const;

  private:
    // The content from the next byte on; empty at its end.
    std::string_view rest() const { return content_.from(at_); }
    void skip_blanks();
    // Goes behind the next end of a line.
    void skip_line();
    // Goes behind the bytes of an array, and returns where they begin.
    std::uint64_t stored(VtkType type, std::uint64_t count);
    template <class T>
    void read_bytes(VtkType type, std::uint64_t count, std::vector<T>& values);
    template <class T>
    void read_words(std::uint64_t count, bool finite, std::vector<T>& values);

    // The next words that are whole, as one piece; empty at the end.
    std::string_view whole_words() const;
    void check_room(std::uint64_t count) const;
    // Throws UserError: the file ends after that many of `count` numbers.
    [[noreturn]] void refuse_end(std::uint64_t index, std::uint64_t count);

    const Content& content_;
    bool binary_ = false;
    std::uint64_t at_ = 0, last_ = 0;  // the next byte, and the first byte of the last word
};

extern template std::vector<double> LegacyText::numbers<double>(VtkType, std::uint64_t, bool);
extern template std::vector<std::int64_t> LegacyText::numbers<std::int64_t>(VtkType, std::uint64_t, bool);

// Whether a section begins with this word.
bool is_legacy_keyword(std::string_view word);

// The name that a word stands for. A blank is written as "%20" there, and other characters by their codes.
std::string legacy_name(std::string_view word);

}  // namespace grainreel
