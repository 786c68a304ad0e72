// The keys of a document: assignments from the command line, and checks that every key is known and was read.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "engine/base/error.hpp"
#include "engine/scene/document.hpp"
#include "engine/scene/key_path.hpp"

namespace grainreel {
namespace {

// Of each pair a scene may have one. Setting one on the command line takes the other out of the file.
constexpr std::array<std::array<std::string_view, 2>, 3> rivals{{
    {"g_level", "amplitude"},
    {"density", "mass"},
    {"restitution", "normal_damping"},
}};

// "species[1].count" or "species.big.count" -> species, 1 or big, count
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

// `text` as TOML where it is TOML and the key does not want text; otherwise as a string.
toml::table parsed_value(const std::string& text, const Key* key) {
    const bool quoted = !text.empty() && (text.front() == '"' || text.front() == '\'');
    const bool wants_text = key != nullptr && (key->kind == KeyKind::text || key->kind == KeyKind::choice);
    if (quoted || !wants_text) {
        try {
            return toml::parse("value = " + text);
        } catch (const toml::parse_error&) {
        }
    }
    return toml::table{{"value", text}};
}

}  // namespace

toml::node* Document::step_into(toml::node& node, const std::string& part, const std::string& assignment) {
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
    throw UserError(fmt::format("--set {}: there is no '{}' among the {} entries; they count from 0",
                                assignment, part, array->size()));
}

void Document::set(const std::string& assignment) {
    const auto equals = assignment.find('=');
    const std::vector<std::string> parts = parts_of(assignment.substr(0, equals));
    if (equals == std::string::npos || parts.empty())
        throw UserError(
            fmt::format("--set {}: no assignment; write --set drive.frequency=\"30 Hz\"", assignment));

    toml::node* node = &root_;
    std::string table;  // path of `node`, with indices
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
        toml::node* inner = step_into(*node, parts[i], assignment);
        if (const toml::array* array = node->as_array()) {
            std::size_t index = 0;
            while (array->get(index) != inner) ++index;
            table += fmt::format("[{}]", index);
        } else {
            table = join_path(table, parts[i]);
        }
        node = inner;
        if (written_.count(table) == 0) written_[table] = {"--set " + assignment.substr(0, equals), 0, 0};
    }
    if (node == nullptr || !node->is_table())
        throw UserError(
            fmt::format("--set {}: '{}' is not a table; name one of its own keys", assignment, table));

    const std::string path = join_path(table, parts.back());
    const auto forget = [&](const std::string& name) {
        node->as_table()->erase(name);
        const std::string gone = join_path(table, name);
        for (auto at = written_.lower_bound(gone);
             at != written_.end() && at->first.compare(0, gone.size(), gone) == 0;) {
            const char next = at->first.size() > gone.size() ? at->first[gone.size()] : '.';
            at = next == '.' || next == '[' ? written_.erase(at) : std::next(at);
        }
    };
    for (const auto& [one, other] : rivals) {
        if (parts.back() == one) forget(std::string(other));
        if (parts.back() == other) forget(std::string(one));
    }
    forget(parts.back());
    const toml::table parsed = parsed_value(assignment.substr(equals + 1), find_key(path));
    parsed.get("value")->visit(
        [&](const auto& value) { node->as_table()->insert_or_assign(parts.back(), value); });
    written_[path] = {"--set " + assignment.substr(0, equals), 0, 0};
}

void Document::check_keys() const {
    check_table("", root_);
}

void Document::check_table(const std::string& path, const toml::table& table) const {
    for (const auto& entry : table) check_entry(join_path(path, entry.first.str()), entry.second);
}

void Document::check_entry(const std::string& path, const toml::node& node) const {
    const bool is_value = find_key(path) != nullptr;
    if (is_value && node.is_table() && is_table_path(path)) return check_table(path, *node.as_table());
    if (is_value) return;
    if (is_table_array_path(path)) {
        const toml::array* array = node.as_array();
        if (array == nullptr || !array->is_array_of_tables() || array->empty())
            fail(path, fmt::format("must be a list of tables; write [[{}]] above its keys", path));
        for (std::size_t i = 0; i < array->size(); ++i)
            check_table(fmt::format("{}[{}]", path, i), *array->get(i)->as_table());
        return;
    }
    if (is_table_path(path)) {
        if (!node.is_table()) fail(path, fmt::format("must be a table; write [{}] above its keys", path));
        return check_table(path, *node.as_table());
    }
    const std::string table = table_of(path);
    throw UserError(fmt::format("{}: unknown key '{}' {} {}; {}", place(path), name_of(path),
                                table.front() == '[' ? "in" : "at", table, advice_for_unknown_key(path)));
}

void Document::check_all_read() const {
    check_read("", root_);
}

void Document::check_read(const std::string& path, const toml::node& node) const {
    const bool is_value = find_key(path) != nullptr && !(node.is_table() && is_table_path(path));
    if (is_value && read_.count(path) == 0)
        fail(path, "is of no use here: nothing in this scene needs it; remove it");
    if (const toml::table* table = node.as_table()) {
        for (const auto& entry : *table) check_read(join_path(path, entry.first.str()), entry.second);
    } else if (const toml::array* array = node.as_array(); array != nullptr && is_table_array_path(path)) {
        for (std::size_t i = 0; i < array->size(); ++i)
            check_read(fmt::format("{}[{}]", path, i), *array->get(i));
    }
}

}  // namespace grainreel
