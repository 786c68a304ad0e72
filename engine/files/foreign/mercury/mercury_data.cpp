// Reads two files of MercuryDPM: .data has the grains, .fstat has the contacts. Both are text, frame after
// frame. The file .restart is read in mercury_restart.cpp.
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "engine/base/counted.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"
#include "engine/files/foreign/tables/number_words.hpp"
#include "engine/files/foreign/tables/text_frames.hpp"

namespace grainreel {

namespace {

using Numbers = std::vector<double>;

// The box between its lowest corner and its highest one, which are the two halves of `corners`.
WorldCell box_between(const Numbers& corners) {
    const std::size_t dimensions = corners.size() / 2;
    WorldCell box;
    for (std::size_t axis = 0; axis < dimensions; ++axis) {
        const double from = corners[axis], to = corners[dimensions + axis];
        box.origin[static_cast<int>(axis)] = from;
        box.edges[axis][static_cast<int>(axis)] = std::max(0.0, to - from);
    }
    return box;
}

class MercuryFile : public TextFrames {
  protected:
    MercuryFile(const std::filesystem::path& file, const char* format) : TextFrames(file) {
        facts_.format = format;
        facts_.program = "MercuryDPM";
    }

    // The number in a word of a row. column: number of the column, from 1. Throws UserError where it is no
    // number.
    double number_in_row(const TextLine& line, std::string_view word, std::size_t column,
                         const char* name) const {
        const std::optional<double> number = number_in(word, Dialect::programs);
        if (!number)
            fault(line,
                  fmt::format("column {} ({}) has {}, which is no number", column, name, in_quotes(word)));
        return *number;
    }
};

// Grains. A line of count, time and box stands before the rows of each frame. In three dimensions this line
// has 8 numbers and a row has 14; in two dimensions they have 6 and 8 (formats 14 and 8 of xballs files). The
// names are in the order of a row's numbers.

constexpr std::array<const char*, 14> names_3d{"x",     "y",    "z",     "vx", "vy", "vz", "radius",
                                               "alpha", "beta", "gamma", "wx", "wy", "wz", "info"};
constexpr std::array<const char*, 8> names_2d{"x", "y", "vx", "vy", "radius", "gamma", "wz", "info"};

// The line before a frame: number of grains, time, lowest corner, highest corner.
struct DataHeader {
    std::int64_t grains = 0;
    double time = 0;
    Numbers corners;
    std::size_t dimensions = 3;
};

std::optional<DataHeader> data_header_of(std::string_view line) {
    const std::optional<std::int64_t> grains = whole_in(take_word(line));
    const std::optional<double> time = number_in(take_word(line), Dialect::programs);
    const std::optional<Numbers> corners = numbers_of(line);
    if (!grains || *grains < 0 || !time || !std::isfinite(*time) || !corners) return std::nullopt;
    if (corners->size() != 4 && corners->size() != 6) return std::nullopt;
    for (const double corner : *corners)
        if (!std::isfinite(corner)) return std::nullopt;
    return DataHeader{*grains, *time, *corners, corners->size() / 2};
}

// The box; none where its highest corner is below its lowest one along an axis.
std::optional<WorldCell> box_of(const DataHeader& header) {
    for (std::size_t axis = 0; axis < header.dimensions; ++axis)
        if (header.corners[header.dimensions + axis] < header.corners[axis]) return std::nullopt;
    return box_between(header.corners);
}

class MercuryData : public MercuryFile {
  public:
    explicit MercuryData(const std::filesystem::path& file) : MercuryFile(file, "MercuryDPM data") {}

  protected:
    Passed pass_over(LineReader& lines, TextLine& line, RawMoment& moment) override;
    RawFrame read_frame(LineReader& lines, const RawMoment& moment) const override;

  private:
    std::size_t columns() const { return dimensions_ == 2 ? names_2d.size() : names_3d.size(); }
    const char* name(std::size_t i) const { return dimensions_ == 2 ? names_2d[i] : names_3d[i]; }
    void add_row(const TextLine& line, RawTable& grains) const;

    std::size_t dimensions_ = 0;  // 0 before the first frame
};

TextFrames::Passed MercuryData::pass_over(LineReader& lines, TextLine& line, RawMoment& moment) {
    if (!lines.next_with_words(line)) return Passed::end;
    const std::optional<DataHeader> header = data_header_of(line.text);
    if (!line.ended) return Passed::cut;
    const std::int64_t first = line.number;
    if (!header)
        fault(line,
              "the line of a frame must stand here: count, time and the box's corners; is the count of the "
              "frame before right?");
    if (dimensions_ == 0) dimensions_ = header->dimensions;
    if (dimensions_ != header->dimensions)
        fault(line,
              fmt::format("this frame has {} dimensions, those before {}", header->dimensions, dimensions_));
    facts_.dimensions = static_cast<int>(dimensions_);
    for (std::int64_t i = 0; i < header->grains; ++i) {
        if (!lines.next(line)) return Passed::cut;
        const std::size_t words = count_words(line.text, columns() + 1);
        if (words < columns() && !line.ended) return Passed::cut;
        if (words != columns())
            fault(line, fmt::format("row {} of {} has {} in place of {}; line {} says {}: is that "
                                    "right?",
                                    i + 1, header->grains,
                                    words > columns() ? "more numbers" : counted(words, "number"), columns(),
                                    first, counted(header->grains, "grain")));
    }
    moment.grains = header->grains;
    moment.time = header->time;
    return Passed::frame;
}

void MercuryData::add_row(const TextLine& line, RawTable& grains) const {
    std::string_view rest = line.text;
    for (std::size_t i = 0; i < columns(); ++i) {
        const std::string_view word = take_word(rest);
        const double number = number_in_row(line, word, i + 1, name(i));
        if (i < dimensions_ && !std::isfinite(number))
            fault(line, fmt::format("the grain has no place: its {} is {}", name(i), in_quotes(word)));
        grains.columns[i].values.push_back(number);
    }
}

RawFrame MercuryData::read_frame(LineReader& lines, const RawMoment& moment) const {
    RawFrame frame;
    frame.time = moment.time;
    TextLine line;
    lines.next_with_words(line);
    if (const std::optional<DataHeader> header = data_header_of(line.text)) frame.box = box_of(*header);
    for (std::size_t i = 0; i < columns(); ++i) frame.grains.columns.push_back({name(i), {}, {}});
    for (std::int64_t i = 0; i < moment.grains; ++i) {
        if (!lines.next(line)) fault(line, "the file has become shorter while it was read");
        add_row(line, frame.grains);
    }
    frame.grains.rows = static_cast<std::size_t>(moment.grains);
    return frame;
}

bool takes_mercury_data(const FileStart& head) {
    if (head.folder) return false;
    const std::vector<std::string_view> lines = lines_of(head, 2);
    if (lines.empty()) return false;
    const std::optional<DataHeader> header = data_header_of(lines[0]);
    if (!header) return false;
    if (lines.size() < 2) return header->grains == 0 || head.bytes.size() < kHeadBytes;
    if (header->grains == 0) return data_header_of(lines[1]).has_value();
    const std::optional<Numbers> row = numbers_of(lines[1]);
    return row && row->size() == (header->dimensions == 2 ? names_2d.size() : names_3d.size());
}

// Contacts. Three lines with "#" stand before the rows of each frame. Version 1 of the format has each pair
// twice, once from either side; the reader keeps the first of the two rows. A partner with a negative number
// is a wall.

constexpr std::size_t columns_of_file = 16;  // the time, then contact_names in this order
constexpr std::array<const char*, 15> contact_names{
    "id1", "id2", "x",  "y",  "z",  "overlap", "tangential_overlap", "Fn", "Ft",
    "nx",  "ny",  "nz", "tx", "ty", "tz"};
constexpr std::size_t first_place = 2;  // index of "x" in contact_names

std::optional<Numbers> numbers_of_remark(std::string_view line) {
    line = trimmed(line);
    if (!line.starts_with('#')) return std::nullopt;
    return numbers_of(line.substr(1));
}

struct ContactsHeader {
    double time = 0;
    WorldCell box;
};

// The header in these three lines; none where they are no header.
std::optional<ContactsHeader> contacts_header_of(const std::array<std::optional<Numbers>, 3>& lines) {
    if (!lines[0] || !lines[1] || !lines[2]) return std::nullopt;
    if (lines[0]->size() != 2 || lines[1]->size() != 6 || lines[2]->size() < 6) return std::nullopt;
    if (!std::isfinite(lines[0]->front())) return std::nullopt;
    ContactsHeader header;
    header.time = lines[0]->front();
    header.box = box_between(*lines[1]);
    return header;
}

class MercuryContacts : public MercuryFile {
  public:
    explicit MercuryContacts(const std::filesystem::path& file) : MercuryFile(file, "MercuryDPM contacts") {}

  protected:
    Passed pass_over(LineReader& lines, TextLine& line, RawMoment& moment) override;
    RawFrame read_frame(LineReader& lines, const RawMoment& moment) const override;

  private:
    // row: a contact was read; last: the frame has no more; cut: the file ends within a row.
    enum class Row { row, last, cut };
    std::optional<ContactsHeader> read_header(LineReader& lines, TextLine& line) const;
    Row next_row(LineReader& lines, TextLine& line) const;
    Numbers numbers(const TextLine& line) const;
};

// Reads the header; none where the file ends within it.
std::optional<ContactsHeader> MercuryContacts::read_header(LineReader& lines, TextLine& line) const {
    std::array<std::optional<Numbers>, 3> three;
    for (std::optional<Numbers>& one : three) {
        if (!lines.next_with_words(line) || !line.ended) return std::nullopt;
        one = numbers_of_remark(line.text);
    }
    std::optional<ContactsHeader> header = contacts_header_of(three);
    if (!header) fault(line, "the three lines with # that begin a frame must end here: time, box, radii");
    return header;
}

MercuryContacts::Row MercuryContacts::next_row(LineReader& lines, TextLine& line) const {
    TextLine next;
    if (!lines.next_with_words(next)) return Row::last;
    if (trimmed(next.text).starts_with('#')) {
        lines.back(next);
        return Row::last;
    }
    line = next;
    const std::size_t words = count_words(line.text, columns_of_file + 1);
    if (words < columns_of_file && !line.ended) return Row::cut;
    if (words != columns_of_file)
        fault(line, fmt::format("a contact has {} numbers in place of {}",
                                words > columns_of_file ? "more" : std::to_string(words), columns_of_file));
    return Row::row;
}

TextFrames::Passed MercuryContacts::pass_over(LineReader& lines, TextLine& line, RawMoment& moment) {
    if (!lines.next_with_words(line)) return Passed::end;
    lines.back(line);
    const std::optional<ContactsHeader> header = read_header(lines, line);
    if (!header) return Passed::cut;
    moment.time = header->time;
    moment.has_contacts = true;
    for (;;) {
        const Row row = next_row(lines, line);
        if (row == Row::cut) return Passed::cut;
        if (row == Row::last) return Passed::frame;
        if (!line.ended) return Passed::frame;
    }
}

Numbers MercuryContacts::numbers(const TextLine& line) const {
    Numbers row;
    std::string_view rest = line.text;
    take_word(rest);
    for (std::size_t i = 0; i < contact_names.size(); ++i) {
        const std::string_view word = take_word(rest);
        const double number = number_in_row(line, word, i + 2, contact_names[i]);
        const bool whole = std::isfinite(number) && std::floor(number) == number;
        if (i < first_place && !whole)
            fault(line, fmt::format("column {} ({}) has {}, which is no grain", i + 2, contact_names[i],
                                    in_quotes(word)));
        if (i >= first_place && i < first_place + 3 && !std::isfinite(number))
            fault(line,
                  fmt::format("the contact has no place: its {} is {}", contact_names[i], in_quotes(word)));
        row.push_back(number);
    }
    return row;
}

RawFrame MercuryContacts::read_frame(LineReader& lines, const RawMoment& moment) const {
    RawFrame frame;
    frame.time = moment.time;
    TextLine line;
    if (const std::optional<ContactsHeader> header = read_header(lines, line)) frame.box = header->box;
    for (const char* name : contact_names) frame.contacts.columns.push_back({name, {}, {}});
    std::map<std::pair<double, double>, int> waiting;  // pairs that were seen only from one side so far
    while (next_row(lines, line) == Row::row) {
        const Numbers row = numbers(line);
        const auto other = waiting.find({row[1], row[0]});
        if (other != waiting.end() && other->second > 0 && row[0] != row[1]) {
            --other->second;
            continue;
        }
        ++waiting[{row[0], row[1]}];
        for (std::size_t i = 0; i < row.size(); ++i) frame.contacts.columns[i].values.push_back(row[i]);
    }
    frame.contacts.rows = frame.contacts.columns.front().values.size();
    return frame;
}

bool takes_mercury_contacts(const FileStart& head) {
    if (head.folder) return false;
    const std::vector<std::string_view> lines = lines_of(head, 3);
    return lines.size() == 3 && contacts_header_of({numbers_of_remark(lines[0]), numbers_of_remark(lines[1]),
                                                    numbers_of_remark(lines[2])});
}

}  // namespace

RawFormat mercury_data_format() {
    return {"mercury-data", "grains of MercuryDPM (.data)", takes_mercury_data,
            open_text_frames<MercuryData>};
}

RawFormat mercury_contacts_format() {
    return {"mercury-contacts", "contacts of MercuryDPM (.fstat)", takes_mercury_contacts,
            open_text_frames<MercuryContacts>};
}

}  // namespace grainreel
