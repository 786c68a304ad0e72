// Reads XYZ, plain and extended. A frame is a count, a line of words, and a row for each grain. In plain XYZ
// a row has an element, a place and perhaps columns without names; in extended XYZ the second line names all
// columns (libAtoms' extxyz).

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"
#include "engine/files/foreign/tables/number_words.hpp"
#include "engine/files/foreign/tables/text_frames.hpp"
#include "engine/files/frames/stored_world.hpp"

namespace grainreel {

namespace {

// One entry of Properties, "velo:R:3": `count` columns of a kind.
struct XyzField {
    std::string name;
    char kind = 'R';  // as in extended XYZ: S word, R real, I whole number, L logical
    std::size_t count = 1;
};

// The second line of a frame: words of any kind, or in extended XYZ keys with values.
struct XyzHeader {
    std::vector<XyzField> fields;  // empty for plain XYZ, where the first row tells them
    std::optional<WorldCell> box;
    std::optional<double> time;
    std::optional<std::int64_t> step;
};

struct XyzEntry {
    std::string key;                   // in lower case
    std::optional<std::string> value;  // none for a key that stands alone
};

constexpr std::string_view blanks = " \t";
constexpr std::size_t most_columns = 4096;  // columns of all entries of Properties together

std::string_view past_blanks(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text;
}

char closing_of(char open) {
    return open == '{' ? '}' : open == '[' ? ']' : open;
}

// Length of the value in brackets or quotes at the front, with its closing mark.
std::size_t length_of_enclosed(std::string_view text) {
    const char open = text.front(), close = closing_of(open);
    int depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\') {
            ++i;
        } else if (open == close) {
            if (i > 0 && text[i] == close) return i + 1;
        } else if (text[i] == open) {
            ++depth;
        } else if (text[i] == close && --depth == 0) {
            return i + 1;
        }
    }
    return text.size();
}

// Takes a value from the front of the text: what stands in quotes or brackets, or the text up to one of
// `ends`.
std::string take_value(std::string_view& text, std::string_view ends) {
    if (!text.empty() && std::string_view("\"'{[").find(text.front()) != std::string_view::npos) {
        const std::size_t length = length_of_enclosed(text);
        const bool closed = length > 1 && text[length - 1] == closing_of(text.front());
        const std::string value(text.substr(1, length - (closed ? 2 : 1)));
        text.remove_prefix(length);
        return value;
    }
    const std::size_t length = std::min(text.find_first_of(ends), text.size());
    const std::string value(text.substr(0, length));
    text.remove_prefix(length);
    return value;
}

// Numbers that blanks, commas or brackets separate.
std::vector<double> list_of(const std::string& value, const char* key) {
    std::string text = value;
    for (char& c : text)
        if (std::string_view(",;[]{}()").find(c) != std::string_view::npos) c = ' ';
    std::vector<double> numbers;
    for (const std::string_view word : words_of(text)) {
        const std::optional<double> number = number_in(word, Dialect::programs);
        if (!number || !std::isfinite(*number))
            throw UserError(fmt::format("{} has {}, which is no number", key, in_quotes(word)));
        numbers.push_back(*number);
    }
    return numbers;
}

void read_lattice(const std::string& value, WorldCell& box) {
    const std::vector<double> n = list_of(value, "Lattice");
    if (n.size() == 9) {
        for (std::size_t edge = 0; edge < 3; ++edge)
            box.edges[edge] = Vec3(n[3 * edge], n[3 * edge + 1], n[3 * edge + 2]);
    } else if (n.size() == 3) {
        box.edges = {Vec3(n[0], 0, 0), Vec3(0, n[1], 0), Vec3(0, 0, n[2])};
    } else {
        throw UserError(
            fmt::format("Lattice has {} numbers; it is three vectors of three numbers each", n.size()));
    }
}

void read_periods(const std::string& value, WorldCell& box) {
    std::string text = lower_case(value);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == ',' || c == '[' || c == ']'; }, ' ');
    const std::vector<std::string_view> words = words_of(text);
    if (words.size() != 3)
        throw UserError(fmt::format("pbc is {}; it is three of T and F", in_quotes(value)));
    for (std::size_t axis = 0; axis < 3; ++axis)
        box.periodic[axis] = words[axis] == "t" || words[axis] == "true" || words[axis] == "1";
}

XyzField field_of(std::string_view name, std::string_view kind, std::string_view count) {
    constexpr const char* what = "as in species:S:1:pos:R:3";
    if (name.empty())
        throw UserError(fmt::format("Properties has an entry without a name; write it {}", what));
    if (kind.size() != 1 || std::string_view("SRIL").find(kind.front()) == std::string_view::npos)
        throw UserError(fmt::format("Properties gives {} the type {}; it is S, R, I or L, {}",
                                    in_quotes(name), in_quotes(kind), what));
    const std::optional<std::int64_t> columns = whole_in(count);
    if (!columns || *columns < 1 || *columns > static_cast<std::int64_t>(most_columns))
        throw UserError(fmt::format("Properties gives {} {} columns; it is a number from 1 on, {}",
                                    in_quotes(name), in_quotes(count), what));
    return {std::string(name), kind.front(), static_cast<std::size_t>(*columns)};
}

std::vector<XyzField> fields_of(std::string_view text) {
    std::vector<std::string_view> parts;
    for (std::size_t colon = text.find(':');; colon = text.find(':')) {
        parts.push_back(trimmed(text.substr(0, colon)));
        if (colon == std::string_view::npos) break;
        text.remove_prefix(colon + 1);
    }
    if (parts.size() % 3 != 0)
        throw UserError("Properties is not of the form name:type:columns, as in species:S:1:pos:R:3");
    std::vector<XyzField> fields;
    std::size_t columns = 0;
    for (std::size_t i = 0; i < parts.size(); i += 3) {
        fields.push_back(field_of(parts[i], parts[i + 1], parts[i + 2]));
        if (fields.back().name == "pos" && fields.back().count > 3)
            throw UserError(
                fmt::format("Properties gives pos {} columns; a place has 3", fields.back().count));
        columns += fields.back().count;
    }
    if (columns > most_columns) throw UserError(fmt::format("Properties names {} columns", columns));
    const bool placed = std::any_of(fields.begin(), fields.end(), [](const XyzField& field) {
        return field.name == "pos" && (field.kind == 'R' || field.kind == 'I');
    });
    if (!placed) throw UserError("Properties has no pos:R:3, so that no grain has a place");
    return fields;
}

// LAMMPS writes "Atoms. Timestep: 1000" into plain XYZ.
std::optional<std::int64_t> step_of_lammps(std::string_view line) {
    constexpr std::string_view mark = "Timestep:";
    const std::size_t at = line.find(mark);
    if (at == std::string_view::npos) return std::nullopt;
    line.remove_prefix(at + mark.size());
    return whole_in(take_word(line));
}

// The entries of a line. Blanks may stand around "=", and values may stand in "", '', {} or [].
std::vector<XyzEntry> xyz_entries(std::string_view line) {
    std::vector<XyzEntry> entries;
    for (line = past_blanks(line); !line.empty(); line = past_blanks(line)) {
        XyzEntry entry;
        if (line.front() != '=') entry.key = lower_case(take_value(line, " \t="));
        const std::string_view behind = past_blanks(line);
        if (behind.starts_with('=')) {
            line = past_blanks(behind.substr(1));
            entry.value = take_value(line, blanks);
        }
        entries.push_back(std::move(entry));
    }
    return entries;
}

// Whether the line is one of extended XYZ, which has Properties or a Lattice.
bool is_extended_xyz(std::string_view line) {
    if (line.find('=') == std::string_view::npos) return false;
    const std::vector<XyzEntry> entries = xyz_entries(line);
    return std::any_of(entries.begin(), entries.end(), [](const XyzEntry& entry) {
        return (entry.key == "properties" || entry.key == "lattice") && entry.value;
    });
}

// Reads the second line of a frame. Throws UserError that says what is wrong with the line; the caller adds
// the name of the file.
XyzHeader xyz_header_of(std::string_view line) {
    XyzHeader header;
    if (!is_extended_xyz(line)) {
        header.step = step_of_lammps(line);
        return header;
    }
    WorldCell box;
    box.periodic = {true, true, true};  // what other programs understand by a Lattice without pbc
    bool has_lattice = false;
    for (const auto& [key, value] : xyz_entries(line)) {
        if (!value) continue;
        if (key == "properties") header.fields = fields_of(*value);
        if (key == "pbc") read_periods(*value, box);
        if (key == "time") header.time = number_in(*value, Dialect::programs);
        if (key == "step" || key == "timestep") header.step = whole_in(*value);
        if (key == "origin") {
            const std::vector<double> n = list_of(*value, "Origin");
            if (n.size() != 3) throw UserError("Origin is three numbers");
            box.origin = Vec3(n[0], n[1], n[2]);
        }
        if (key == "lattice") {
            read_lattice(*value, box);
            has_lattice = true;
        }
    }
    if (has_lattice) header.box = box;
    return header;
}

using Words = std::vector<std::string_view>;

constexpr std::size_t most_words = std::size_t{1} << 16;  // words of a row

// The count in a line that has nothing else; none for other lines.
std::optional<std::int64_t> count_of(std::string_view line) {
    const std::optional<std::int64_t> count = whole_in(trimmed(line));
    return count && *count >= 0 ? count : std::nullopt;
}

CellKind kind_of(char kind) {
    return kind == 'S' ? CellKind::word : kind == 'L' ? CellKind::logical : CellKind::number;
}

std::vector<ColumnFiller> named_columns(const std::vector<XyzField>& fields) {
    std::vector<ColumnFiller> columns;
    for (const XyzField& field : fields)
        for (std::size_t i = 0; i < field.count; ++i) {
            const std::string name = field.name == "pos" ? std::string(1, "xyz"[i])
                                     : field.count == 1  ? field.name
                                                         : fmt::format("{}:{}", field.name, i);
            columns.emplace_back(name, kind_of(field.kind));
        }
    return columns;
}

// Plain XYZ does not name its columns; "c5" is the fifth.
std::vector<ColumnFiller> plain_columns(const Words& row) {
    std::vector<ColumnFiller> columns;
    columns.emplace_back("species", CellKind::word_or_number);
    for (const char* name : {"x", "y", "z"}) columns.emplace_back(name, CellKind::number);
    for (std::size_t i = columns.size(); i < row.size(); ++i)
        columns.emplace_back(fmt::format("c{}", i + 1),
                             number_in(row[i], Dialect::programs) ? CellKind::number : CellKind::word);
    return columns;
}

bool is_place(const std::string& name) {
    return name == "x" || name == "y" || name == "z";
}

class XyzFile : public TextFrames {
  public:
    explicit XyzFile(const std::filesystem::path& file) : TextFrames(file) { facts_.format = "XYZ"; }

  protected:
    Passed pass_over(LineReader& lines, TextLine& line, RawMoment& moment) override;
    RawFrame read_frame(LineReader& lines, const RawMoment& moment) const override;

  private:
    XyzHeader header_of(const TextLine& line) const;
    std::vector<ColumnFiller> columns_of(const TextLine& line, const XyzHeader& header,
                                         const Words& row) const;
    void add_row(const TextLine& line, std::vector<ColumnFiller>& columns, const Words& row) const;
};

XyzHeader XyzFile::header_of(const TextLine& line) const {
    try {
        return xyz_header_of(line.text);
    } catch (const UserError& error) {
        fault(line, error.what());
    }
}

std::vector<ColumnFiller> XyzFile::columns_of(const TextLine& line, const XyzHeader& header,
                                              const Words& row) const {
    if (!header.fields.empty()) return named_columns(header.fields);
    if (row.size() < 4)
        fault(line,
              "a row of XYZ has an element and x, y, z; this one has fewer words; is the count above right?");
    return plain_columns(row);
}

void XyzFile::add_row(const TextLine& line, std::vector<ColumnFiller>& columns, const Words& row) const {
    if (row.size() != columns.size())
        fault(line, fmt::format("this row has {} in place of {}; is the count of grains right?",
                                counted(row.size(), "column"), columns.size()));
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (!columns[i].add(row[i]))
            fault(line, fmt::format("column {} ({}) has {}, which is {}", i + 1, columns[i].name(),
                                    in_quotes(row[i]), name_of_wrong(columns[i].kind())));
        if (is_place(columns[i].name()) && !std::isfinite(columns[i].last()))
            fault(line,
                  fmt::format("the grain has no place: its {} is {}", columns[i].name(), in_quotes(row[i])));
    }
}

TextFrames::Passed XyzFile::pass_over(LineReader& lines, TextLine& line, RawMoment& moment) {
    if (!lines.next_with_words(line)) return Passed::end;
    const std::optional<std::int64_t> count = count_of(line.text);
    if (!count) {
        if (!line.ended) return Passed::cut;
        fault(line, fmt::format("the count of grains of a frame must stand here, not {}; is the count of the "
                                "frame before right?",
                                in_quotes(trimmed(line.text))));
    }
    const std::int64_t first = line.number;
    if (!line.ended || !lines.next(line)) return *count == 0 && line.ended ? Passed::frame : Passed::cut;
    if (!line.ended && *count > 0) return Passed::cut;
    const XyzHeader header = header_of(line);
    if (!header.fields.empty()) facts_.format = "extended XYZ";
    std::size_t columns = 0;
    for (const XyzField& field : header.fields) columns += field.count;
    for (std::int64_t i = 0; i < *count; ++i) {
        if (!lines.next(line)) return Passed::cut;
        const std::size_t words = count_words(line.text, columns == 0 ? most_words : columns + 1);
        if (columns == 0) columns = words;
        if (words < columns && !line.ended) return Passed::cut;
        if (words != columns || words < 2)
            fault(line,
                  fmt::format("row {} of {} has {} in place of {}; line {} says {}: is that "
                              "right?",
                              i + 1, *count, words > columns ? "more columns" : counted(words, "column"),
                              columns, first, counted(*count, "grain")));
    }
    moment.grains = *count;
    moment.time = header.time;
    moment.step = header.step;
    return Passed::frame;
}

RawFrame XyzFile::read_frame(LineReader& lines, const RawMoment& moment) const {
    RawFrame frame;
    frame.time = moment.time;
    frame.step = moment.step;
    TextLine line;
    lines.next_with_words(line);
    XyzHeader header;
    if (lines.next(line)) header = header_of(line);
    frame.box = header.box;
    std::vector<ColumnFiller> columns = named_columns(header.fields);
    if (columns.empty()) columns = plain_columns({});
    Words row;
    for (std::int64_t i = 0; i < moment.grains; ++i) {
        if (!lines.next(line)) fault(line, "the file has become shorter while it was read");
        split_words(line.text, row);
        if (i == 0) columns = columns_of(line, header, row);
        add_row(line, columns, row);
    }
    frame.grains.rows = static_cast<std::size_t>(moment.grains);
    for (ColumnFiller& column : columns) frame.grains.columns.push_back(column.finish());
    return frame;
}

bool takes_xyz(const FileStart& head) {
    if (head.folder) return false;
    std::string_view rest = head.bytes;
    constexpr std::string_view mark = "\xef\xbb\xbf";
    if (rest.starts_with(mark)) rest.remove_prefix(mark.size());
    Words lines;  // blank lines too, because a comment may be empty
    for (int i = 0; i < 4 && !rest.empty(); ++i) {
        const std::size_t length = std::min(rest.find('\n'), rest.size());
        lines.push_back(trimmed(rest.substr(0, length)));
        rest.remove_prefix(std::min(length + 1, rest.size()));
    }
    if (lines.size() < 2) return false;
    const std::optional<std::int64_t> count = count_of(lines[0]);
    if (!count) return false;
    if (lines.size() < 3) return *count == 0 || is_extended_xyz(lines[1]);
    if (is_extended_xyz(lines[1])) return true;
    if (*count == 0) return count_of(lines[2]).has_value();
    const Words row = words_of(lines[2]);
    return row.size() >= 4 && std::all_of(row.begin() + 1, row.begin() + 4, [](std::string_view word) {
               return number_in(word, Dialect::programs).has_value();
           });
}

}  // namespace

RawFormat xyz_format() {
    return {"xyz", "XYZ, plain and extended", takes_xyz, open_text_frames<XyzFile>};
}

}  // namespace grainreel
