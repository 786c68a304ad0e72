// How a table of numbers is written: what separates its cells, how its numbers look, what its columns are
// called. It is found by trying the first lines of the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grainreel {

struct TableLayout {
    char separator = ',';        // ' ': blanks and tabs, any number of them
    bool decimal_comma = false;  // "1,5"
    bool closed = false;         // a separator ends each row; no cell comes behind it
    bool named = false;          // the file names its columns; otherwise they are "c1", "c2", ...
    std::vector<std::string> names;
    std::vector<bool> is_word;     // of each column: it holds words
    std::uint64_t head_lines = 0;  // before the first row
    std::string program;           // that writes tables of this kind, where the names tell
};

// None where the text is no table. `whole`: the text is the whole file.
std::optional<TableLayout> layout_of(std::string_view text, bool whole);

// The cells of a row, without blanks and quotes around them. Where rows are `closed`, a separator at the end
// makes no cell.
void split_cells(std::string_view line, char separator, bool closed, std::vector<std::string_view>& cells);

// What a cell holds; NaN for an empty one and for "NA", none for what is no number.
std::optional<double> cell_number(std::string_view cell, bool decimal_comma);

// Lines of remarks: "#", "%", "//".
bool is_remark(std::string_view line);

// The name without its unit, in small letters: "x" of "X [mm]".
std::string bare_name(std::string_view name);
// What stands in brackets behind a name: "mm"; empty where there is none.
std::string unit_of_name(std::string_view name);

}  // namespace grainreel
