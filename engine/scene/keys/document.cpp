#include "engine/scene/keys/document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/keys/keys.hpp"

namespace grainreel {
namespace {

constexpr std::size_t most_of_parser = 200;  // characters of the parser's own message

// Checked here because toml++ says only that the character is unknown.
void check_utf8(std::string_view text, const std::string& file) {
    const std::optional<std::size_t> bad = first_byte_not_utf8(text);
    if (!bad) return;
    const std::string_view before = text.substr(0, *bad);
    const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
    throw UserError("{}:{}:{}: the byte 0x{:02x} is not UTF-8; save the file as UTF-8", file,
                    std::count(before.begin(), before.end(), '\n') + 1, *bad - start + 1,
                    static_cast<unsigned char>(text[*bad]));
}

// Whether a comma stands between two digits at that place, which a TOML parser does not expect.
bool is_decimal_comma(std::string_view text, const toml::source_position& place) {
    std::size_t start = 0;
    for (toml::source_index line = 1; line < place.line; ++line) {
        start = text.find('\n', start);
        if (start++ == std::string_view::npos) return false;
    }
    const std::size_t comma = start + place.column - 1;
    const auto is_digit = [&](std::size_t i) { return text[i] >= '0' && text[i] <= '9'; };
    return comma > 0 && comma + 1 < text.size() && text[comma] == ',' && is_digit(comma - 1) &&
           is_digit(comma + 1);
}

toml::table parse(std::string_view text, const std::string& file) {
    check_utf8(text, file);
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        std::string what(error.description());
        std::replace(what.begin(), what.end(), '\n', ' ');
        const toml::source_position& place = error.source().begin;
        const char* advice = is_decimal_comma(text, place)
                                 ? "a number has a point in place of the comma, as in 9.5"
                                 : "text and quantities with units want quotes";
        throw UserError("{}:{}:{}: this is not TOML ({}); {}", file, place.line, place.column,
                        excerpt(what, most_of_parser), advice);
    }
}

}  // namespace

Document::Document(std::string_view text, std::string file, const std::vector<Key>& keys)
    : keys_(&keys), file_(std::move(file)), root_(parse(text, file_)) {
    record("", root_);
}

void Document::record(const std::string& path, const toml::node& node) {
    if (const toml::table* table = node.as_table()) {
        for (const auto& [key, value] : *table) {
            const std::string inside = join_path(path, key.str());
            const toml::source_position at = key.source().begin;
            written_[inside] = {file_, static_cast<int>(at.line), static_cast<int>(at.column)};
            record(inside, value);
        }
    } else if (const toml::array* array = node.as_array()) {
        for (std::size_t i = 0; i < array->size(); ++i) {
            const std::string inside = fmt::format("{}[{}]", path, i);
            const toml::source_position at = array->get(i)->source().begin;
            written_[inside] = {file_, static_cast<int>(at.line), static_cast<int>(at.column)};
            record(inside, *array->get(i));
        }
    }
}

std::string Document::place(const std::string& path) const {
    Scene places;
    places.file = file_;
    places.written = written_;
    return places.where(path);
}

bool Document::from_command_line(const std::string& path) const {
    const auto found = written_.find(path);
    return found != written_.end() && found->second.line == 0;
}

void Document::fail(const std::string& path, const std::string& what) const {
    throw UserError("{}: '{}' {}", place(path), excerpt(name_of(path)), what);
}

void Document::fail_missing(const std::string& path) const {
    const std::string table = parent_of(path);
    const Key* key = find_key(path, *keys_);
    throw UserError("{}: {} lacks '{}'; write for example {} = {}", place(table), table_of(path),
                    name_of(path), name_of(path), key->example());
}

void Document::refuse(const std::string& path, const std::string& reason) const {
    if (has(path)) fail(path, fmt::format("is of no use here: {}; remove it", reason));
}

const toml::node* Document::find(const std::string& path) const {
    return toml::at_path(root_, path).node();
}

const toml::node* Document::read(const std::string& path) {
    read_.insert(path);
    return find(path);
}

bool Document::has(const std::string& path) const {
    return find(path) != nullptr;
}

std::size_t Document::size(const std::string& path) const {
    const toml::node* node = find(path);
    return node != nullptr && node->is_array() ? node->as_array()->size() : 0;
}

bool Document::is_table(const std::string& path) const {
    const toml::node* node = find(path);
    return node != nullptr && node->is_table();
}

bool Document::is_array(const std::string& path) const {
    const toml::node* node = find(path);
    return node != nullptr && node->is_array();
}

bool Document::is_text(const std::string& path) const {
    const toml::node* node = find(path);
    return node != nullptr && node->is_string();
}

std::string Document::written_value(const std::string& path) const {
    return written_value(*find(path));
}

std::string Document::written_value(const toml::node& node) const {
    if (const auto text = node.value_exact<std::string>()) return "\"" + excerpt(*text) + "\"";
    std::ostringstream text;
    text << toml::node_view<const toml::node>(node);
    std::string value = text.str();
    std::replace(value.begin(), value.end(), '\n', ' ');
    return excerpt(value);
}

// A phase without a unit is in turns. Whole turns would mean nothing, so 90 is surely meant in degrees.
void Document::check_bare_phase(const std::string& path, const toml::node& node) const {
    const double turns = node.value<double>().value_or(0);
    if (std::isfinite(turns) && std::abs(turns) > 1)
        fail(path,
             fmt::format("is in turns without a unit, and must be from -1 to 1 then, but is {0}; write for "
                         "example \"{0} deg\"",
                         written_value(node)));
}

namespace {

// Moves a value that is beyond a bound only by the rounding of a unit (90 degrees as a quarter of a turn) to
// that bound.
double snapped(double value, const Range& range) {
    constexpr double rounding = 1e-12;
    for (const double bound : {range.low, range.high})
        if (std::isfinite(bound) && !range.contains(value) &&
            std::abs(value - bound) <= rounding * std::abs(bound))
            return bound;
    return value;
}

}  // namespace

double Document::number_in(const std::string& path, const toml::node& node, const Key& key) const {
    const DimensionText& dimension = text_of(key.dimension);
    const auto wrong = [&](const std::string& must) {
        fail(path, fmt::format("must be {}, but is {}; write for example {}", must, written_value(node),
                               key.example()));
    };
    double value = 0;
    if (const auto whole = node.value_exact<std::int64_t>()) {
        value = static_cast<double>(*whole);
    } else if (const auto real = node.value_exact<double>()) {
        value = *real;
    } else if (const auto text = node.value_exact<std::string>()) {
        try {
            // No one example suits every key that is a pure number.
            value =
                parse_quantity(*text, key.dimension, key.dimension == Dimension::number ? key.example() : "");
            value = snapped(value, key.range);
        } catch (const UserError& error) {
            fail(path, error.what());
        }
    } else {
        wrong(dimension.noun);
    }
    if (key.dimension == Dimension::phase && node.is_number()) check_bare_phase(path, node);
    if (std::isnan(value)) wrong(dimension.noun);
    if (std::isinf(value) && !key.range.infinite) wrong("finite");
    if (!key.range.contains(value)) wrong(key.range.text());
    if (const Range bounds = key.bounds(); !bounds.contains(value))
        wrong(bounds.text() + (key.dimension == Dimension::number ? "" : std::string(" ") + dimension.unit));
    return value;
}

std::optional<double> Document::quantity(const std::string& path) {
    const toml::node* node = read(path);
    if (node == nullptr) return std::nullopt;
    return number_in(path, *node, *find_key(path, *keys_));
}

std::optional<double> Document::quantity(const std::string& path, Dimension dimension) {
    const toml::node* node = read(path);
    if (node == nullptr) return std::nullopt;
    Key key = *find_key(path, *keys_);
    key.dimension = dimension;
    return number_in(path, *node, key);
}

std::optional<std::int64_t> Document::integer(const std::string& path) {
    const toml::node* node = read(path);
    if (node == nullptr) return std::nullopt;
    const Key& key = *find_key(path, *keys_);
    const auto whole = node->value_exact<std::int64_t>();
    if (!whole || !key.range.contains(static_cast<double>(*whole)))
        fail(path, fmt::format("must be a whole number {}, but is {}; write for example {}", key.range.text(),
                               written_value(*node), key.example()));
    return whole;
}

std::optional<bool> Document::flag(const std::string& path) {
    const toml::node* node = read(path);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value_exact<bool>();
    if (!value) fail(path, fmt::format("must be true or false, but is {}", written_value(*node)));
    return value;
}

// A name must fit on one line, in tables and in comments. U+0000 would cut text off wherever C reads it.
void Document::check_characters(const std::string& path, const std::string& text) const {
    const bool a_name = name_of(path) == "name";
    const auto control = a_name                                 ? first_control_character(text)
                         : text.find('\0') != std::string::npos ? std::optional(0u)
                                                                : std::nullopt;
    if (control)
        fail(path, fmt::format("holds the control character U+{:04X} in \"{}\"; take it out", *control,
                               excerpt(text)));
}

std::optional<std::string> Document::text(const std::string& path) {
    const toml::node* node = read(path);
    if (node == nullptr) return std::nullopt;
    const Key& key = *find_key(path, *keys_);
    const auto value = node->value_exact<std::string>();
    if (!value)
        fail(path, fmt::format("must be text, but is {}; write for example {}", written_value(*node),
                               key.example()));
    check_characters(path, *value);
    if (const std::size_t letters = letters_in(*value); letters > key.most_letters)
        fail(path,
             fmt::format("has {} characters, and the most are {}; shorten it", letters, key.most_letters));
    const auto& known = key.choices;
    if (key.kind == KeyKind::choice && !contains(known, *value))
        fail(path,
             fmt::format("must be \"{}\", but is {}", fmt::join(known, "\" or \""), written_value(*node)));
    return value;
}

std::optional<Vec3> Document::vector(const std::string& path) {
    const toml::node* node = read(path);
    if (node == nullptr) return std::nullopt;
    Key element = *find_key(path, *keys_);
    element.range = Range{};
    const toml::array* array = node->as_array();
    if (array == nullptr || array->size() != 3)
        fail(path, fmt::format("must be three numbers, but is {}; write for example {}", written_value(*node),
                               element.kind == KeyKind::vector ? element.example() : "[0, 0, 1]"));
    Vec3 value;
    for (int i = 0; i < 3; ++i) value[i] = number_in(path, *array->get(static_cast<std::size_t>(i)), element);
    return value;
}

std::optional<std::vector<std::string>> Document::names(const std::string& path) {
    const toml::node* node = read(path);
    if (node == nullptr) return std::nullopt;
    std::vector<std::string> values;
    if (const toml::array* array = node->as_array())
        for (const toml::node& element : *array)
            if (const auto name = element.value_exact<std::string>()) values.push_back(*name);
    if (values.size() != 2 || values.size() != size(path))
        fail(path, fmt::format("must be two names, but is {}; write for example {}", written_value(*node),
                               find_key(path, *keys_)->example()));
    return values;
}

std::vector<std::array<double, 2>> Document::speed_table(const std::string& path) {
    const toml::node* node = read(path);
    if (node == nullptr) return {};
    const Key& key = *find_key(path, *keys_);
    Key number = key;
    number.dimension = Dimension::number;
    const toml::array* rows = node->as_array();
    const auto wrong = [&] {
        fail(path, fmt::format("must be rows of a speed and a number, at most {}, but is {}; write for "
                               "example {}",
                               kTablePoints, written_value(*node), key.example()));
    };
    if (rows == nullptr || rows->empty() || rows->size() > kTablePoints) wrong();
    std::vector<std::array<double, 2>> values;
    for (const toml::node& row : *rows) {
        const toml::array* two = row.as_array();
        if (two == nullptr || two->size() != 2) wrong();
        values.push_back({number_in(path, *two->get(0), key), number_in(path, *two->get(1), number)});
    }
    return values;
}

std::optional<std::array<std::int64_t, 2>> Document::two_integers(const std::string& path) {
    const toml::node* node = read(path);
    const toml::array* array = node == nullptr ? nullptr : node->as_array();
    if (array == nullptr || array->size() != 2) return std::nullopt;
    const auto first = array->get(0)->value_exact<std::int64_t>();
    const auto second = array->get(1)->value_exact<std::int64_t>();
    if (!first || !second) return std::nullopt;
    return std::array<std::int64_t, 2>{*first, *second};
}

double Document::required_quantity(const std::string& path) {
    if (const auto value = quantity(path)) return *value;
    fail_missing(path);
}

std::string Document::required_text(const std::string& path) {
    if (const auto value = text(path)) return *value;
    fail_missing(path);
}

}  // namespace grainreel
