// Splits lines into words as programs write them, and fills columns of a table with words and numbers.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

// Removes the first word from the text and returns it; empty at the end.
std::string_view take_word(std::string_view& text);
// All words of a line, which blanks and tabs separate.
void split_words(std::string_view line, std::vector<std::string_view>& words);
std::vector<std::string_view> words_of(std::string_view line);
// The number of these words, counted up to `most`.
std::size_t count_words(std::string_view line, std::size_t most);
// The numbers of a line; none where one of its words is not a number.
std::optional<std::vector<double>> numbers_of(std::string_view line);

// The text with ASCII letters in lower case.
std::string lower_case(std::string_view text);

// A word of a file for a message: in quotes, cut where it is long, and safe for a terminal.
std::string in_quotes(std::string_view word);

// What the cells of a column hold.
enum class CellKind {
    number,
    logical,  // T and F, true and false, 1 and 0
    word,
    word_or_number,  // words, unless all of them are whole numbers
};

// A column that is filled word by word. Words are numbered alphabetically, so that a word has the same number
// in two frames with the same words.
class ColumnFiller {
  public:
    ColumnFiller(std::string name, CellKind kind) : kind_(kind) { column_.name = std::move(name); }

    const std::string& name() const { return column_.name; }
    CellKind kind() const { return kind_; }
    // Adds a word. Returns whether it is of the column's kind.
    bool add(std::string_view word);
    void add_number(double value) { column_.values.push_back(value); }
    double last() const { return column_.values.back(); }
    // Gives the column away. Nothing can be added afterwards.
    RawColumn finish();

  private:
    bool add_word(std::string_view word);

    CellKind kind_;
    RawColumn column_;
    std::map<std::string, double, std::less<>>
        numbers_;  // numbers of the words until finish(), in the order in which they came
};

// How a message names a word that is not of the kind: "no number".
const char* name_of_wrong(CellKind kind);

}  // namespace grainreel
