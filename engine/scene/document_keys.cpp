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
constexpr std::array<std::array<std::string_view, 2>, 9> rivals{{
    {"g_level", "amplitude"},
    {"density", "mass"},
    {"restitution", "normal_damping"},
    {"restitution", "restitution_table"},
    {"position", "azimuth"},  // of the camera
    {"position", "elevation"},
    {"position", "key"},
    {"file", "settle_limit"},  // of the start, from a file or by layers
    {"file", "settle_damping"},
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

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(" \t");
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// `text` as TOML where it is TOML and the key does not want text; otherwise as a string.
toml::table parsed_value(const std::string& text, const Key* key) {
    const bool quoted = !text.empty() && (text.front() == '"' || text.front() == '\'');
    const bool wants_text = key != nullptr && (key->kind == KeyKind::text || key->kind == KeyKind::choice);
    // "0x0" is a hexadecimal number to TOML.
    const bool plain_size = key != nullptr && key->kind == KeyKind::picture_size && text.rfind('[', 0) != 0;
    if (quoted || !(wants_text || plain_size)) {
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

// The table that the last of `parts` lies in, made where it is missing, and its path with indices.
std::pair<toml::table*, std::string> Document::table_for(const std::vector<std::string>& parts,
                                                         const std::string& assignment, const Location& by) {
    toml::node* node = &root_;
    std::string path;
    for (std::size_t i = 0; i + 1 < parts.size() && node != nullptr; ++i) {
        toml::node* inner = step_into(*node, parts[i], assignment);
        if (const toml::array* array = node->as_array()) {
            std::size_t index = 0;
            while (array->get(index) != inner) ++index;
            path += fmt::format("[{}]", index);
        } else {
            path = join_path(path, parts[i]);
        }
        node = inner;
        written_.try_emplace(path, by);
    }
    if (node == nullptr || !node->is_table())
        throw UserError(
            fmt::format("--set {}: '{}' is not a table; name one of its own keys", assignment, path));
    return {node->as_table(), path};
}

// Takes a key out, and the places of all that was below it.
void Document::remove(toml::table& table, const std::string& table_path, std::string_view key) {
    table.erase(key);
    const std::string gone = join_path(table_path, key);
    const auto below = [&](const std::string& path) {
        return path == gone || path.rfind(gone + ".", 0) == 0 || path.rfind(gone + "[", 0) == 0;
    };
    std::erase_if(written_, [&](const auto& entry) { return below(entry.first); });
}

void Document::set(const std::string& assignment) {
    const auto equals = assignment.find('=');
    const std::string name = trimmed(assignment.substr(0, equals));
    const std::vector<std::string> parts = parts_of(name);
    if (equals == std::string::npos || parts.empty())
        throw UserError(
            fmt::format("--set {}: no assignment; write --set drive.frequency=\"30 Hz\"", assignment));

    const Location by{"--set " + name, 0, 0};
    const auto [table, table_path] = table_for(parts, assignment, by);
    const std::string& key = parts.back();
    for (const auto& [one, other] : rivals) {
        if (key == one) remove(*table, table_path, other);
        if (key == other) remove(*table, table_path, one);
    }
    remove(*table, table_path, key);
    const std::string path = join_path(table_path, key);
    toml::table parsed = parsed_value(trimmed(assignment.substr(equals + 1)), find_key(path));
    toml::table& target = *table;
    parsed.get("value")->visit([&](const auto& value) { target.insert_or_assign(key, value); });
    written_[path] = by;
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
