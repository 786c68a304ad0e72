// Finds out how a table of numbers is written by trying the first lines of the file: what separates its
// cells, how numbers are written and what its columns are called.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/csv.hpp"

namespace grainreel {

struct TableLayout {
    CsvForm form;
    bool decimal_comma = false;  // "1,5"
    bool named = false;          // the file names its columns; otherwise they are "c1", "c2", ...
    std::vector<std::string> names;
    std::vector<bool> is_word;    // for each column: whether it holds words
    std::int64_t head_lines = 0;  // number of lines before the first row
    std::string program;          // the program that writes such tables, if the names tell
};

// The layout of a text; none where it is no table. whole: the text is the whole file.
std::optional<TableLayout> layout_of(std::string_view text, bool whole);

// The number in a cell: NaN for an empty one and for "NA", none where it is not a number.
std::optional<double> cell_number(std::string_view cell, bool decimal_comma);

// Whether a line is a remark: it begins with "#", "%" or "//".
bool is_remark(std::string_view line);

// A name without its unit and in lower case: "x" for "X [mm]".
std::string bare_name(std::string_view name);

}  // namespace grainreel
