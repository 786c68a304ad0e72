// Columns of a table that are filled word by word, as a text file has them.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

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
