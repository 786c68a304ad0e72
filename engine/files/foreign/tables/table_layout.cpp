#include "engine/files/foreign/tables/table_layout.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/lists.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"
#include "engine/files/foreign/names.hpp"
#include "engine/files/foreign/tables/number_words.hpp"
#include "engine/scene/text/units.hpp"

namespace grainreel {

namespace {

using Cells = std::vector<CsvCell>;

constexpr std::size_t most_rows = 40;  // rows from which the layout is found

// A way in which a table can be written.
struct Notation {
    char separator;
    bool decimal_comma;
};

// The first lines of a file.
struct Sample {
    std::vector<std::string_view> remarks, filled;
    std::vector<std::int64_t> numbers;  // numbers of the lines that are not blank, from 1
};

// The text without blanks at both ends. Tabs stay, because they may separate cells.
std::string_view trimmed_blanks(std::string_view line) {
    while (line.starts_with(' ')) line.remove_prefix(1);
    while (line.ends_with(' ') || line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

std::string_view without_return(std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

std::optional<Sample> sample_of(std::string_view text, bool whole) {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    if (text.starts_with(mark)) text.remove_prefix(mark.size());
    Sample sample;
    for (std::int64_t number = 1; !text.empty() && sample.filled.size() < most_rows; ++number) {
        const std::size_t length = text.find('\n');
        if (length == std::string_view::npos && !whole) break;
        const std::string_view line = without_return(text.substr(0, length));
        if (line.find('\0') != std::string_view::npos) return std::nullopt;
        text.remove_prefix(length == std::string_view::npos ? text.size() : length + 1);
        if (trimmed(line).empty()) continue;
        if (is_remark(line)) {
            if (sample.filled.empty()) sample.remarks.push_back(line);
            continue;
        }
        sample.filled.push_back(line);
        sample.numbers.push_back(number);
    }
    return sample;
}

bool is_number(std::string_view cell, bool decimal_comma) {
    return !cell.empty() && cell_number(cell, decimal_comma).has_value();
}

// Whether the cells can be names of columns: none is a number, and not all are empty.
bool are_names(const Cells& cells, bool decimal_comma) {
    const bool number = std::any_of(cells.begin(), cells.end(),
                                    [&](const CsvCell& cell) { return is_number(cell.text, decimal_comma); });
    const bool any =
        std::any_of(cells.begin(), cells.end(), [](const CsvCell& cell) { return !cell.text.empty(); });
    return any && !number;
}

// ParaView names a component of a vector "Points:0"; newer versions write "Points_0".
std::string name_of(std::string_view cell, std::size_t column) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (cell == fmt::format("Points:{}", axis) || cell == fmt::format("Points_{}", axis))
            return std::string(1, "xyz"[axis]);
    std::string name(cell);
    for (std::size_t quote = name.find("\"\""); quote != std::string::npos;
         quote = name.find("\"\"", quote + 1))
        name.erase(quote, 1);
    return name.empty() ? fmt::format("c{}", column + 1) : name;
}

void name_columns(TableLayout& layout, const Cells& cells) {
    layout.named = true;
    for (std::size_t i = 0; i < layout.names.size(); ++i)
        layout.names[i] = name_of(i < cells.size() ? cells[i].text : std::string_view{}, i);
}

// The names in YADE's "#format x_y_z_r_matId".
std::optional<Cells> format_of_yade(const Sample& sample) {
    for (std::string_view line : sample.remarks) {
        if (take_word(line) != "#format") continue;
        std::string_view rest = trimmed(line);
        Cells names;
        for (std::size_t underscore = rest.find('_');; underscore = rest.find('_')) {
            names.push_back({rest.substr(0, underscore)});
            if (underscore == std::string_view::npos) return names;
            rest.remove_prefix(underscore + 1);
        }
    }
    return std::nullopt;
}

// The names in a remark before the rows, as numpy and gnuplot write them: "# x y z radius".
void name_by_remarks(TableLayout& layout, const Sample& sample) {
    if (const std::optional<Cells> names = format_of_yade(sample)) {
        layout.program = "YADE";
        if (names->size() <= layout.names.size()) name_columns(layout, *names);
        return;
    }
    if (sample.remarks.empty()) return;
    std::string_view line = sample.remarks.back();
    line.remove_prefix(std::min(line.find_first_not_of("#%/ \t"), line.size()));
    for (const char separator : {layout.form.separator, ' '}) {
        CsvForm form = layout.form;
        form.separator = separator;
        Cells cells;
        split_cells(line, form, cells);
        if (cells.size() != layout.names.size() || !are_names(cells, layout.decimal_comma)) continue;
        name_columns(layout, cells);
        return;
    }
}

std::string program_of(const TableLayout& layout) {
    const auto has = [&](const char* name) { return contains(layout.names, name); };
    if (!layout.program.empty()) return layout.program;
    if (has("X") && has("Y") && has("Z") && has("r")) return "DEM-Engine";
    if (has("p_x") && has("p_y") && has("diameters")) return "Lethe";
    return {};
}

// The word in a cell of units: "mm" in "mm", "[mm]" and "(mm)".
std::string_view unit_word(std::string_view cell) {
    cell = trimmed(cell);
    if (cell.size() > 1 && (cell.front() == '[' || cell.front() == '('))
        cell = cell.substr(1, cell.size() - 2);
    return trimmed(cell);
}

// Whether a word names a unit, perhaps in another case than it should ("MM"). A long word does not, so that
// udunits' table is not read for the second line of any text.
bool names_unit(std::string_view word) {
    constexpr std::size_t longest = 12;
    return word == "-" || (word.size() <= longest && (parse_unit(word) || parse_unit(lower_case(word))));
}

// Whether a row holds the units of the columns: "m", "[mm]", "-". Most of its cells must, because in
// "1,1,1,b" the "b" is a type of grains and no barn.
bool are_units(const Cells& cells) {
    std::size_t units = 0, others = 0;
    for (const CsvCell& cell : cells) {
        const std::string_view word = unit_word(cell.text);
        if (word.empty()) continue;
        const bool unit = names_unit(word);
        if (!unit && word != "1") return false;
        ++(unit ? units : others);
    }
    return units > others;
}

// Moves the units from a row of their own into the names: "x [mm]".
void add_units(TableLayout& layout, const Cells& cells) {
    for (std::size_t i = 0; i < std::min(cells.size(), layout.names.size()); ++i) {
        const std::string_view unit = unit_word(cells[i].text);
        if (!unit.empty() && unit != "-" && unit != "1") layout.names[i] += fmt::format(" [{}]", unit);
    }
}

// Whether a column with that name must hold only numbers: it has a meaning, and is not that of types.
bool must_be_numbers(const std::string& name) {
    const std::string bare = bare_name(name);
    for (const std::string& meaning : all_meanings())
        for (const std::string& known : names_of(meaning))
            if (meaning != "type" && bare == known) return true;
    return false;
}

// Finds out for each column whether it holds words. A column that must hold numbers counts as one of words
// only if at least half of its filled cells are words; otherwise a word there is a mistake in its row.
// Returns none where a row has another number of cells than the others.
std::optional<std::vector<bool>> words_in(const Sample& sample, std::size_t first, const TableLayout& layout,
                                          bool last_may_be_cut) {
    const std::size_t columns = layout.names.size();
    std::vector<std::size_t> words(columns, 0), filled(columns, 0);
    Cells cells;
    for (std::size_t i = first; i < sample.filled.size(); ++i) {
        split_cells(sample.filled[i], layout.form, cells);
        if (cells.size() < columns && last_may_be_cut && i + 1 == sample.filled.size() && i > first) break;
        if (cells.size() != columns) return std::nullopt;
        for (std::size_t k = 0; k < columns; ++k) {
            words[k] += !cell_number(cells[k].text, layout.decimal_comma);
            filled[k] += !cells[k].text.empty();
        }
    }
    std::vector<bool> is_word(columns);
    for (std::size_t k = 0; k < columns; ++k)
        is_word[k] = words[k] > 0 && (2 * words[k] >= filled[k] || !must_be_numbers(layout.names[k]));
    return is_word;
}

bool names_places(const std::vector<std::string>& names) {
    const auto has = [&](const char* wanted) {
        return std::any_of(names.begin(), names.end(),
                           [&](const std::string& name) { return bare_name(name) == wanted; });
    };
    return has("x") && has("y");
}

// The layout of the sample if it is written in this way; none where it is not, or is no table of grains.
std::optional<TableLayout> layout_by(const Sample& sample, const Notation& writing, bool whole) {
    TableLayout layout;
    layout.form = {.separator = writing.separator, .quotes = true};
    layout.form.closed =
        writing.separator != ' ' && trimmed_blanks(sample.filled.front()).ends_with(writing.separator);
    layout.decimal_comma = writing.decimal_comma;
    Cells first;
    split_cells(sample.filled.front(), layout.form, first);
    if (first.size() < 2) return std::nullopt;
    layout.names.resize(first.size());
    for (std::size_t i = 0; i < first.size(); ++i) layout.names[i] = fmt::format("c{}", i + 1);
    const bool header = are_names(first, writing.decimal_comma);
    if (header) {
        name_columns(layout, first);
    } else {
        name_by_remarks(layout, sample);
    }
    std::size_t rows_from = header ? 1 : 0;
    if (header && sample.filled.size() > 1) {
        Cells units;
        split_cells(sample.filled[1], layout.form, units);
        if (units.size() == first.size() && are_units(units)) {
            add_units(layout, units);
            rows_from = 2;
        }
    }
    const auto words = words_in(sample, rows_from, layout, whole);
    if (!words) return std::nullopt;
    layout.is_word = *words;
    layout.head_lines = rows_from > 0 ? sample.numbers[rows_from - 1] : sample.numbers.front() - 1;
    layout.program = program_of(layout);
    const auto numbers = static_cast<std::size_t>(std::count(words->begin(), words->end(), false));
    if (header && sample.filled.size() == rows_from)
        return names_places(layout.names) ? std::optional(layout) : std::nullopt;
    if (!layout.named && (numbers < first.size() || numbers < 3)) return std::nullopt;
    return numbers >= 2 ? std::optional(layout) : std::nullopt;
}

std::ptrdiff_t word_columns(const TableLayout& layout) {
    return std::count(layout.is_word.begin(), layout.is_word.end(), true);
}

}  // namespace

std::optional<TableLayout> layout_of(std::string_view text, bool whole) {
    const std::optional<Sample> sample = sample_of(text, whole);
    if (!sample || sample->filled.empty()) return std::nullopt;
    // The first separator that fits is taken. Of decimal point and comma, the one that makes fewer columns
    // words is taken.
    for (const char separator : {';', '\t', ',', ' '}) {
        const std::optional<TableLayout> point = layout_by(*sample, {separator, false}, whole);
        const std::optional<TableLayout> comma =
            separator == ',' ? std::nullopt : layout_by(*sample, {separator, true}, whole);
        if (comma && (!point || word_columns(*comma) < word_columns(*point))) return comma;
        if (point) return point;
    }
    return std::nullopt;
}

std::optional<double> cell_number(std::string_view cell, bool decimal_comma) {
    if (cell.empty() || cell == "NA" || cell == "N/A" || cell == "null" || cell == "NULL") return kUnknown;
    if (!decimal_comma || cell.find(',') == std::string_view::npos) return number_in(cell, Dialect::programs);
    std::string with_point(cell);
    if (with_point.find('.') != std::string::npos) return std::nullopt;
    with_point[with_point.find(',')] = '.';
    return number_in(with_point, Dialect::programs);
}

bool is_remark(std::string_view line) {
    line = trimmed(line);
    return line.starts_with('#') || line.starts_with('%') || line.starts_with("//");
}

std::string bare_name(std::string_view name) {
    return lower_case(trimmed(name.substr(0, name.find_first_of("[("))));
}

}  // namespace grainreel
