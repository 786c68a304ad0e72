// Reads XYZ, plain and extended. A frame is a count, a line of words, and a row for each grain. In plain XYZ
// a row has an element, a place and perhaps columns without names; in extended XYZ the second line names all
// columns (libAtoms' extxyz).

#include <fmt/format.h>
#include <algorithm>
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
#include "engine/files/foreign/tables/xyz_header.hpp"
#include "engine/files/frames/stored_world.hpp"

namespace grainreel {

namespace {

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
