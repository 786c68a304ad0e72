#include "engine/files/foreign/tables/xyz_header.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"
#include "engine/files/foreign/tables/number_words.hpp"

namespace grainreel {

namespace {

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
            throw UserError("{} has {}, which is no number", key, in_quotes(word));
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
        throw UserError("Lattice has {} numbers; it is three vectors of three numbers each", n.size());
    }
}

void read_periods(const std::string& value, WorldCell& box) {
    std::string text = lower_case(value);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == ',' || c == '[' || c == ']'; }, ' ');
    const std::vector<std::string_view> words = words_of(text);
    if (words.size() != 3) throw UserError("pbc is {}; it is three of T and F", in_quotes(value));
    for (std::size_t axis = 0; axis < 3; ++axis)
        box.periodic[axis] = words[axis] == "t" || words[axis] == "true" || words[axis] == "1";
}

XyzField field_of(std::string_view name, std::string_view kind, std::string_view count) {
    constexpr const char* what = "as in species:S:1:pos:R:3";
    if (name.empty()) throw UserError("Properties has an entry without a name; write it {}", what);
    if (kind.size() != 1 || std::string_view("SRIL").find(kind.front()) == std::string_view::npos)
        throw UserError("Properties gives {} the type {}; it is S, R, I or L, {}", in_quotes(name),
                        in_quotes(kind), what);
    const std::optional<std::int64_t> columns = whole_in(count);
    if (!columns || *columns < 1 || *columns > static_cast<std::int64_t>(most_columns))
        throw UserError("Properties gives {} {} columns; it is a number from 1 on, {}", in_quotes(name),
                        in_quotes(count), what);
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
            throw UserError("Properties gives pos {} columns; a place has 3", fields.back().count);
        columns += fields.back().count;
    }
    if (columns > most_columns) throw UserError("Properties names {} columns", columns);
    const bool placed = std::any_of(fields.begin(), fields.end(), [](const XyzField& field) {
        return field.name == "pos" && (field.kind == 'R' || field.kind == 'I');
    });
    if (!placed) throw UserError("Properties has no pos:R:3, so that no grain has a place");
    return fields;
}

// LAMMPS writes "Atoms. Timestep: 1000" into plain XYZ.
std::optional<std::int64_t> step_of_lammps(std::string_view line) {
    constexpr std::string_view mark = "Timestep:";
    const std::size_t place = line.find(mark);
    if (place == std::string_view::npos) return std::nullopt;
    line.remove_prefix(place + mark.size());
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

}  // namespace

bool is_extended_xyz(std::string_view line) {
    if (line.find('=') == std::string_view::npos) return false;
    const std::vector<XyzEntry> entries = xyz_entries(line);
    return std::any_of(entries.begin(), entries.end(), [](const XyzEntry& entry) {
        return (entry.key == "properties" || entry.key == "lattice") && entry.value;
    });
}

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

}  // namespace grainreel
