// The keys of a document: assignments from the command line, and checks that every key is known and was read.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/keys/document.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/text/toml_text.hpp"

namespace grainreel {

namespace {

// Splits a path: "species[1].count" or "species.big.count" gives species, 1 or big, count.
std::vector<std::string> parts_of(const std::string& path) {
    std::vector<std::string> parts;
    std::string part;
    for (const char c : path + ".") {
        if (c == '.' || c == '[' || c == ']') {
            if (!part.empty()) parts.push_back(part);
            part.clear();
        } else {
            part += c;
        }
    }
    return parts;
}

// Reads numbers that everybody but TOML accepts: ".5", "5." and "+.5".
std::optional<double> plain_number(std::string_view text) {
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    if (text.empty() || read.ec != std::errc() || read.ptr != end) return std::nullopt;
    return value;
}

// Reads `text` as TOML where it is TOML and the key does not want text, else as a number or a string.
toml::table parsed_value(const std::string& text, const Key* key) {
    const bool quoted = !text.empty() && (text.front() == '"' || text.front() == '\'');
    const bool a_table = key != nullptr && is_table_path(key->path) && text.rfind('{', 0) == 0;
    const bool wants_text =
        key != nullptr && !a_table && (key->kind == KeyKind::text || key->kind == KeyKind::choice);
    // A picture size such as "0x0" would be a hexadecimal number in TOML.
    const bool plain_size = key != nullptr && key->kind == KeyKind::picture_size && text.rfind('[', 0) != 0;
    if (quoted || !(wants_text || plain_size)) {
        try {
            return toml::parse("value = " + text);
        } catch (const toml::parse_error&) {
        }
    }
    const bool wants_number = !quoted && !wants_text && !plain_size;
    if (const auto number = wants_number ? plain_number(text) : std::nullopt)
        return toml::table{{"value", *number}};
    return toml::table{{"value", text}};
}

}  // namespace

toml::node* Document::step_into(toml::node& node, const std::string& part, const std::string& by) {
    if (toml::table* table = node.as_table()) {
        if (!table->contains(part)) table->insert(part, toml::table{});
        return table->get(part);
    }
    toml::array* array = node.as_array();
    if (array == nullptr) return nullptr;
    const bool is_index = part.find_first_not_of("0123456789") == std::string::npos && part.size() < 9;
    if (is_index && std::stoul(part) < array->size()) return array->get(std::stoul(part));
    for (toml::node& element : *array)
        if (element.is_table() && element.as_table()->at_path("name").value<std::string>() == part)
            return &element;
    std::vector<std::string> names;
    for (const toml::node& element : *array)
        if (const toml::table* entry = element.as_table())
            if (const auto name = entry->at_path("name").value<std::string>()) names.push_back(*name);
    if (is_index || names.empty())
        throw UserError("{}: there is no '{}' among the {}; they count from 0", by, excerpt(part),
                        array->size() == 1 ? "1 entry" : fmt::format("{} entries", array->size()));
    const std::optional<std::string> meant = nearest_name(part, names);
    constexpr std::size_t most_named = 300;  // characters
    throw UserError("{}: there is no '{}'; {}there are {}", by, excerpt(part),
                    meant ? fmt::format("did you mean '{}'? ", excerpt(*meant)) : "",
                    excerpt(fmt::format("{}", fmt::join(names, ", ")), most_named));
}

namespace {

[[noreturn]] void fail_not_a_table(const std::string& path, const Location& by) {
    throw UserError("{}: '{}' is not a table; name one of its own keys", by.file, excerpt(path));
}

}  // namespace

// The table in which the last of `parts` lies, and its path with indices. The table is made if it is missing.
// It also replaces another value of a key that may be a table.
std::pair<toml::table*, std::string> Document::table_for(const std::vector<std::string>& parts,
                                                         const Location& by) {
    toml::node* node = &root_;
    std::string path;
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
        toml::table* const parent = node->as_table();
        toml::node* inner = step_into(*node, parts[i], by.file);
        if (inner == nullptr) fail_not_a_table(path, by);
        if (const toml::array* array = node->as_array()) {
            std::size_t index = 0;
            while (array->get(index) != inner) ++index;
            path += fmt::format("[{}]", index);
        } else {
            path = join_path(path, parts[i]);
        }
        node = inner;
        written_.try_emplace(path, by);
        const bool is_word = !node->is_table() && !node->is_array();
        if (is_word && parent != nullptr && is_table_path(path, *keys_)) {  // outlet = "closed"
            parent->insert_or_assign(parts[i], toml::table{});
            node = parent->get(parts[i]);
            written_[path] = by;
        }
    }
    if (!node->is_table()) fail_not_a_table(path, by);
    return {node->as_table(), path};
}

// Removes a key, and the places of all that was below it.
void Document::remove(toml::table& table, const std::string& table_path, std::string_view key) {
    table.erase(key);
    const std::string gone = join_path(table_path, key);
    const auto below = [&](const std::string& path) {
        return path == gone || path.rfind(gone + ".", 0) == 0 || path.rfind(gone + "[", 0) == 0;
    };
    std::erase_if(written_, [&](const auto& entry) { return below(entry.first); });
}

// Removes from the table what belonged to the old value of `key`.
void Document::take_back(toml::table& table, const std::string& table_path, const std::string& key,
                         const toml::node& value) {
    const Key* known = find_key(join_path(table_path, key), *keys_);
    const auto old = table[key].value<std::string>(), now = value.value<std::string>();
    if (known == nullptr || (old && old == now)) return;
    for (const std::string& own : known->owns)
        if (!from_command_line(join_path(table_path, own))) remove(table, table_path, own);
}

namespace {

// What gave an assignment: the command line, or the file whose name the place begins with.
std::string source_of(const std::string& place) {
    return place.starts_with("--") ? "--" : place.substr(0, place.find(':'));
}

}  // namespace

// A key that excludes others takes their place, but not that of one that the same source gives: which of the
// two is meant?
void Document::remove_rivals(toml::table& table, const std::string& path, const std::string& place) {
    for (const std::string& rival : rivals_of(path, *keys_)) {
        const std::string other = join_path(parent_of(path), rival);
        const auto given = written_.find(other);
        if (table.contains(rival) && given != written_.end() && given->second.line == 0 &&
            source_of(given->second.file) == source_of(place))
            throw UserError("{}: '{}' and '{}' exclude each other, and both are set{}; leave out one", place,
                            path, other,
                            given->second.file == place ? "" : fmt::format(" ({})", given->second.file));
        remove(table, parent_of(path), rival);
    }
}

void Document::set(const Assignment& assignment) {
    const std::string place = assignment.place();
    if (const std::string wrong = complaint_of_utf8(assignment.text); !wrong.empty())
        throw UserError("{}: {}; type it in a UTF-8 terminal", place, wrong);
    const std::vector<std::string> parts = parts_of(assignment.key());
    if (assignment.text.find('=') == std::string::npos || parts.empty())
        throw UserError("{}: no assignment; write --set drive.frequency=\"30 Hz\"", place);

    const Location by{place, 0, 0};
    const auto [table, table_path] = table_for(parts, by);
    const std::string& key = parts.back();
    const std::string path = join_path(table_path, key);
    toml::table parsed = parsed_value(assignment.value(), find_key(path, *keys_));
    const toml::node& value = *parsed.get("value");
    remove_rivals(*table, path, place);
    take_back(*table, table_path, key, value);
    remove(*table, table_path, key);
    written_[path] = by;
    const bool empty_list =
        is_table_array_path(path, *keys_) && value.is_array() && value.as_array()->empty();
    const bool empty_table = value.is_table() && value.as_table()->empty();
    if (empty_list || empty_table) return;
    toml::table& target = *table;
    value.visit([&](const auto& found) { target.insert_or_assign(key, found); });
}

std::string Document::take_out(const std::string& table) {
    const toml::node* const node = root_.get(table);
    if (node == nullptr) return "";
    if (!node->is_table()) fail(table, fmt::format("must be a table; write [{}] above its keys", table));
    toml::table alone = *node->as_table();
    alone.is_inline(false);  // it is written with its own heading
    std::ostringstream text;
    text << toml::table{{table, std::move(alone)}};
    root_.erase(table);
    return "\n" + text.str() + "\n";
}

void Document::check_keys() const {
    check_table("", root_);
}

void Document::check_table(const std::string& path, const toml::table& table) const {
    for (const auto& entry : table) check_entry(join_path(path, entry.first.str()), entry.second);
}

void Document::check_entry(const std::string& path, const toml::node& node) const {
    const bool is_value = find_key(path, *keys_) != nullptr;
    if (is_value && node.is_table() && is_table_path(path, *keys_))
        return check_table(path, *node.as_table());
    if (is_value) return;
    if (is_table_array_path(path, *keys_)) {
        const toml::array* array = node.as_array();
        if (array == nullptr || !array->is_array_of_tables() || array->empty())
            fail(path, fmt::format("must be a list of tables; write [[{}]] above its keys", path));
        for (std::size_t i = 0; i < array->size(); ++i)
            check_table(fmt::format("{}[{}]", path, i), *array->get(i)->as_table());
        return;
    }
    if (is_table_path(path, *keys_)) {
        if (!node.is_table()) fail(path, fmt::format("must be a table; write [{}] above its keys", path));
        return check_table(path, *node.as_table());
    }
    const std::string table = table_of(path);
    throw UserError("{}: unknown key '{}' {} {}; {}", place(path), excerpt(name_of(path)),
                    table.front() == '[' ? "in" : "at", excerpt(table), advice_for_unknown_key(path, *keys_));
}

void Document::check_all_read() const {
    check_read("", root_);
}

void Document::check_read(const std::string& path, const toml::node& node) const {
    const bool is_value =
        find_key(path, *keys_) != nullptr && !(node.is_table() && is_table_path(path, *keys_));
    if (is_value && read_.count(path) == 0)
        fail(path, "is of no use here: nothing in this scene needs it; remove it");
    if (const toml::table* table = node.as_table()) {
        for (const auto& entry : *table) check_read(join_path(path, entry.first.str()), entry.second);
    } else if (const toml::array* array = node.as_array();
               array != nullptr && is_table_array_path(path, *keys_)) {
        for (std::size_t i = 0; i < array->size(); ++i)
            check_read(fmt::format("{}[{}]", path, i), *array->get(i));
    }
}

// The readers of lists: intervals, names, whole numbers, values of any kind.

namespace {

// Writes a value in one line, from which the same bits are read back.
std::string in_one_line(const toml::node& node) {
    if (const auto text = node.value_exact<std::string>()) return quoted(*text);
    if (const auto real = node.value_exact<double>()) return toml_number(*real);
    if (const toml::array* array = node.as_array()) {
        std::vector<std::string> values;
        for (const toml::node& element : *array) values.push_back(in_one_line(element));
        return toml_list(values);
    }
    if (const toml::table* table = node.as_table()) {
        std::vector<std::string> entries;
        for (const auto& [key, value] : *table)
            entries.push_back(fmt::format("{} = {}", quoted(std::string(key.str())), in_one_line(value)));
        return fmt::format("{{ {} }}", fmt::join(entries, ", "));
    }
    std::ostringstream text;
    text << toml::node_view<const toml::node>(node);
    return text.str();
}

// The example of a quantity with 0 in place of its number: "0 mm" for "5 mm".
std::string zero_of(std::string example) {
    const std::size_t from = example.find_first_of("0123456789");
    if (from == std::string::npos) return example;
    const std::size_t end = std::min(example.find_first_not_of("0123456789.e", from), example.size());
    return example.replace(from, end - from, "0");
}

}  // namespace

std::optional<std::array<double, 2>> Document::interval(const std::string& path, Dimension dimension) {
    const toml::node* node = read(path);
    if (node == nullptr) return std::nullopt;
    Key end = *find_key(path, *keys_);
    end.kind = KeyKind::quantity;
    end.dimension = dimension;
    const toml::array* array = node->as_array();
    if (array == nullptr || array->size() != 2)
        fail(path, fmt::format("must be two values, [low, high], but is {}; write for example [{}, {}]",
                               written_value(*node), zero_of(text_of(dimension).example),
                               text_of(dimension).example));
    return std::array<double, 2>{number_in(path, *array->get(0), end), number_in(path, *array->get(1), end)};
}

std::vector<std::string> Document::name_list(const std::string& path) {
    const toml::node* node = read(path);
    if (node == nullptr) return {};
    std::vector<std::string> values;
    if (const toml::array* array = node->as_array())
        for (const toml::node& element : *array)
            if (const auto name = element.value_exact<std::string>()) values.push_back(*name);
    if (values.size() != size(path) || !node->is_array())
        fail(path, fmt::format("must be a list of names, but is {}; write for example {}",
                               written_value(*node), find_key(path, *keys_)->example()));
    return values;
}

std::vector<std::int64_t> Document::integer_list(const std::string& path) {
    const toml::node* node = read(path);
    if (node == nullptr) return {};
    const Key& key = *find_key(path, *keys_);
    std::vector<std::int64_t> values;
    if (const toml::array* array = node->as_array())
        for (const toml::node& element : *array)
            if (const auto whole = element.value_exact<std::int64_t>();
                whole && key.range.contains(static_cast<double>(*whole)))
                values.push_back(*whole);
    if (values.size() != size(path) || !node->is_array())
        fail(path, fmt::format("must be a list of whole numbers {}, but is {}; write for example {}",
                               key.range.text(), written_value(*node), key.example()));
    return values;
}

std::vector<std::string> Document::value_list(const std::string& path) {
    const toml::node* node = read(path);
    if (node == nullptr) return {};
    const toml::array* array = node->as_array();
    if (array == nullptr)
        fail(path, fmt::format("must be a list, but is {}; write for example {}", written_value(*node),
                               find_key(path, *keys_)->example()));
    std::vector<std::string> values;
    for (const toml::node& element : *array) values.push_back(in_one_line(element));
    return values;
}

std::string Document::value(const std::string& path) {
    const toml::node* node = read(path);
    if (node == nullptr) return "";
    if (node->is_array() || node->is_table())
        fail(path, fmt::format("must be one value, but is {}; write for example {}", written_value(*node),
                               find_key(path, *keys_)->example()));
    return in_one_line(*node);
}

std::string Document::as_it_stands(const std::string& path) {
    const toml::node* node = read(path);
    return node == nullptr ? "" : in_one_line(*node);
}

}  // namespace grainreel
