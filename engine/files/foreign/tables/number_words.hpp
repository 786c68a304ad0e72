// Words and numbers as programs write them into text files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

// "1.5", "+1.5", ".5", "1.5d0" (Fortran), "nan", "inf", "-1.#IND" (NaN); numbers too small for a double are
// 0. None where the word is no number as a whole.
std::optional<double> number_of(std::string_view word);
// "324", "+324"; none for anything else and for what needs more than 64 bits.
std::optional<std::int64_t> whole_number_of(std::string_view word);

// Without blanks at both ends.
std::string_view trimmed(std::string_view text);
// Takes the first word off the text; empty at its end.
std::string_view take_word(std::string_view& text);
// All words of a line between blanks and tabs.
void split_words(std::string_view line, std::vector<std::string_view>& words);
std::vector<std::string_view> words_of(std::string_view line);
// How many words those are, up to `most`.
std::size_t count_words(std::string_view line, std::size_t most);
// The numbers of a line; none where one of its words is no number.
std::optional<std::vector<double>> numbers_of(std::string_view line);

// In ASCII letters.
std::string lower_case(std::string_view text);

// A word of a file for a message: in quotes, cut where it is long, without what a terminal cannot show.
std::string in_quotes(std::string_view word);

// Columns of a table that are filled word by word, as a text file has them.

enum class CellKind {
    number,
    logical,  // T and F, true and false, 1 and 0
    word,
    word_or_number,  // a column of words, unless all of them are whole numbers
};

// One column. Words are numbered in the order of the alphabet, so that equal words of two frames have equal
// numbers where the frames have the same words.
class ColumnFiller {
  public:
    ColumnFiller(std::string name, CellKind kind) : kind_(kind) { column_.name = std::move(name); }

    const std::string& name() const { return column_.name; }
    CellKind kind() const { return kind_; }
    // Whether the word is of the column's kind.
    bool add(std::string_view word);
    void add_number(double value) { column_.values.push_back(value); }
    double last() const { return column_.values.back(); }
    // The column; nothing can be added then.
    RawColumn finish();

  private:
    bool add_word(std::string_view word);

    CellKind kind_;
    RawColumn column_;
    std::map<std::string, double, std::less<>> numbers_;  // of each word, in the order of their coming
};

// What a message calls a word that is not of the kind: "no number".
const char* name_of_wrong(CellKind kind);

}  // namespace grainreel
