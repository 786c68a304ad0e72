// MercuryDPM's .fstat: three lines with "#" before the contacts of each frame. Version 1 has each pair twice,
// once from either side; a pair is given once. A partner with a negative number is a wall.
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/files/foreign/tables/number_words.hpp"
#include "engine/files/foreign/tables/text_lines.hpp"

namespace grainreel {

namespace {

using Numbers = std::vector<double>;

constexpr std::size_t columns_of_file = 16;  // the first is the time
constexpr std::array<const char*, 15> names{"id1", "id2", "x",  "y",  "z",  "overlap", "tangential_overlap",
                                            "Fn",  "Ft",  "nx", "ny", "nz", "tx",      "ty",
                                            "tz"};
constexpr std::size_t first_place = 2;  // of the names

std::optional<Numbers> numbers_of_remark(std::string_view line) {
    line = trimmed(line);
    if (!line.starts_with('#')) return std::nullopt;
    return numbers_of(line.substr(1));
}

struct Header {
    double time = 0;
    WorldCell box;
};

// The header that these three lines are, or none.
std::optional<Header> header_of(const std::array<std::optional<Numbers>, 3>& lines) {
    if (!lines[0] || !lines[1] || !lines[2]) return std::nullopt;
    if (lines[0]->size() != 2 || lines[1]->size() != 6 || lines[2]->size() < 6) return std::nullopt;
    if (!std::isfinite(lines[0]->front())) return std::nullopt;
    Header header;
    header.time = lines[0]->front();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double from = (*lines[1])[axis], to = (*lines[1])[axis + 3];
        header.box.origin[static_cast<int>(axis)] = from;
        header.box.edges[axis][static_cast<int>(axis)] = std::max(0.0, to - from);
    }
    return header;
}

class MercuryContacts : public TextFrames {
  public:
    explicit MercuryContacts(const std::filesystem::path& file) : TextFrames(file) {
        facts_.format = "MercuryDPM contacts";
        facts_.program = "MercuryDPM";
    }

  protected:
    Passed pass_over(TextLines& lines, RawMoment& moment) override;
    RawFrame read_frame(TextLines& lines, const RawMoment& moment) const override;

  private:
    enum class Row { row, last, cut };
    Row next_row(TextLines& lines) const;
    Numbers numbers(const TextLines& lines) const;
};

// Reads the header; none where the file ends within it.
std::optional<Header> read_header(TextLines& lines) {
    std::array<std::optional<Numbers>, 3> three;
    for (std::optional<Numbers>& one : three) {
        if (!lines.next_filled() || !lines.ended()) return std::nullopt;
        one = numbers_of_remark(lines.text());
    }
    std::optional<Header> header = header_of(three);
    if (!header) lines.fault("the three lines with # that begin a frame must end here: time, box, radii");
    return header;
}

MercuryContacts::Row MercuryContacts::next_row(TextLines& lines) const {
    if (!lines.next_filled()) return Row::last;
    if (trimmed(lines.text()).starts_with('#')) {
        lines.put_back();
        return Row::last;
    }
    const std::size_t words = count_words(lines.text(), columns_of_file + 1);
    if (words < columns_of_file && !lines.ended()) return Row::cut;
    if (words != columns_of_file)
        lines.fault(fmt::format("a contact has {} numbers in place of {}",
                                words > columns_of_file ? "more" : std::to_string(words), columns_of_file));
    return Row::row;
}

TextFrames::Passed MercuryContacts::pass_over(TextLines& lines, RawMoment& moment) {
    if (!lines.next_filled()) return Passed::end;
    lines.put_back();
    const std::optional<Header> header = read_header(lines);
    if (!header) return Passed::cut;
    moment.time = header->time;
    moment.has_contacts = true;
    for (;;) {
        const Row row = next_row(lines);
        if (row == Row::cut) return Passed::cut;
        if (row == Row::last) return Passed::frame;
        if (!lines.ended()) return Passed::frame;
    }
}

Numbers MercuryContacts::numbers(const TextLines& lines) const {
    Numbers row;
    std::string_view rest = lines.text();
    take_word(rest);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string_view word = take_word(rest);
        const std::optional<double> number = number_of(word);
        if (!number)
            lines.fault(
                fmt::format("column {} ({}) has {}, which is no number", i + 2, names[i], in_quotes(word)));
        const bool whole = std::isfinite(*number) && std::floor(*number) == *number;
        if (i < first_place && !whole)
            lines.fault(
                fmt::format("column {} ({}) has {}, which is no grain", i + 2, names[i], in_quotes(word)));
        if (i >= first_place && i < first_place + 3 && !std::isfinite(*number))
            lines.fault(fmt::format("the contact has no place: its {} is {}", names[i], in_quotes(word)));
        row.push_back(*number);
    }
    return row;
}

RawFrame MercuryContacts::read_frame(TextLines& lines, const RawMoment& moment) const {
    RawFrame frame;
    frame.time = moment.time;
    if (const std::optional<Header> header = read_header(lines)) frame.box = header->box;
    for (const char* name : names) frame.contacts.columns.push_back({name, {}, {}});
    std::map<std::pair<double, double>, int> waiting;  // pairs that were not yet seen from the other side
    while (next_row(lines) == Row::row) {
        const Numbers row = numbers(lines);
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

bool takes_mercury_contacts(const FileHead& head) {
    if (head.folder) return false;
    const std::vector<std::string_view> lines = lines_of(head, 3);
    return lines.size() == 3 &&
           header_of({numbers_of_remark(lines[0]), numbers_of_remark(lines[1]), numbers_of_remark(lines[2])});
}

}  // namespace

RawFormat mercury_contacts_format() {
    return {"mercury-contacts", "contacts of MercuryDPM (.fstat)", takes_mercury_contacts,
            open_text_frames<MercuryContacts>};
}

}  // namespace grainreel
