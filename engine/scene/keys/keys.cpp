// Finds keys in the list, also the nearest to a wrong one, and describes them.
#include "engine/scene/keys/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

#include "engine/base/lists.hpp"
#include "engine/base/text.hpp"

namespace grainreel {

namespace {

// "species[1].count" -> "species[].count"
std::string without_indices(std::string_view path) {
    std::string pattern;
    bool inside = false;
    for (const char c : path) {
        if (c == ']') inside = false;
        if (!inside) pattern += c;
        if (c == '[') inside = true;
    }
    return pattern;
}

// Names of keys and tables directly inside a table, in the list's order.
std::vector<std::string> names_inside(const std::string& table, const std::vector<Key>& keys) {
    const std::string start = table.empty() ? "" : table + ".";
    std::vector<std::string> names;
    for (const Key& key : keys) {
        if (key.path.compare(0, start.size(), start) != 0) continue;
        std::string name = key.path.substr(start.size());
        name = name.substr(0, name.find_first_of(".["));
        if (!contains(names, name)) names.push_back(name);
    }
    return names;
}

std::string heading_of(const std::string& table) {
    if (table.empty()) return "the top level";
    if (table.size() > 2 && table.compare(table.size() - 2, 2, "[]") == 0)
        return "[[" + table.substr(0, table.size() - 2) + "]]";
    return "[" + table + "]";
}

std::string value_words(const Key& key) {
    switch (key.kind) {
        case KeyKind::integer:
            return "whole number";
        case KeyKind::flag:
            return "true or false";
        case KeyKind::text:
            return "text";
        case KeyKind::choice:
            return fmt::format("\"{}\"", fmt::join(key.choices, "\", \""));
        case KeyKind::colour:
            return "colour";
        case KeyKind::vector:
            return "[x, y, z]";
        case KeyKind::picture_size:
            return "\"WxH\" or [W, H]";
        case KeyKind::species_pair:
            return "two names";
        case KeyKind::speed_table:
            return "[[m/s, number], ...]";
        case KeyKind::interval:
            return "[low, high]";
        case KeyKind::name_list:
            return key.choices.empty() ? std::string("list of names")
                                       : fmt::format("list of \"{}\"", fmt::join(key.choices, "\", \""));
        case KeyKind::names_or_all:
            return "list of names, or true";
        case KeyKind::integer_list:
            return "list of whole numbers";
        case KeyKind::seeds:
            return "whole number or a list of them";
        case KeyKind::value:
            return "number or quantity";
        case KeyKind::value_list:
            return "list of values";
        case KeyKind::quantity:
        case KeyKind::gravity:
        case KeyKind::diameter:
            break;
    }
    return key.dimension == Dimension::number ? "number" : text_of(key.dimension).unit;
}

}  // namespace

bool Range::contains(double value) const {
    if (std::isnan(value)) return false;
    if (std::isinf(value)) return infinite && value > 0;
    return (open ? value > low : value >= low) && value <= high;
}

std::string Range::text() const {
    if (std::isfinite(low) && std::isfinite(high))
        return open ? fmt::format("larger than {} and at most {}", low, high)
                    : fmt::format("from {} to {}", low, high);
    if (std::isfinite(low))
        return open ? fmt::format("larger than {}", low) : fmt::format("at least {}", low);
    return infinite ? "" : "finite";
}

std::string Key::example() const {
    if (!fallback.empty()) return fallback;
    if (kind == KeyKind::integer) {
        const double usual = range.low > 1 ? 10 * range.low : 100;
        const double fitting = usual <= range.high ? usual : std::max(range.low, std::floor(range.high / 2));
        return fmt::format("{:.15g}", fitting);
    }
    if (kind == KeyKind::choice) return "\"" + choices.front() + "\"";
    if (kind == KeyKind::text) return "\"small\"";
    if (kind == KeyKind::colour) return "\"orange\"";
    if (kind == KeyKind::species_pair) return "[\"small\", \"wall\"]";
    if (kind == KeyKind::interval) return "[0, 1]";
    if (kind == KeyKind::name_list)
        return choices.size() < 2 ? "[\"small\"]" : fmt::format("[\"{}\", \"{}\"]", choices[0], choices[1]);
    if (kind == KeyKind::names_or_all) return "true";
    if (kind == KeyKind::integer_list) return "[3, 14]";
    if (kind == KeyKind::seeds) return "3";
    if (kind == KeyKind::value) return "\"2 mm\"";
    if (kind == KeyKind::value_list) return "[1, 2, 3]";
    if (kind == KeyKind::vector)
        return dimension == Dimension::number ? "[0, 0, 1]"
                                              : fmt::format("[{}, 0, 0]", text_of(dimension).example);
    if (kind == KeyKind::speed_table) return "[[\"0.1 m/s\", 0.95], [\"2 m/s\", 0.8]]";
    constexpr double usual_number = 0.5;
    if (dimension == Dimension::number && !range.contains(usual_number))
        return fmt::format("{:.15g}", std::isfinite(range.high) ? range.high : range.low + usual_number);
    return text_of(dimension).example;
}

Range Key::bounds() const {
    const DimensionText& size = text_of(dimension);
    Range left = range;
    left.low = std::max(range.low, -size.most);
    left.high = std::min(range.high, size.most);
    if (range.open && range.low == 0 && size.least > 0 && !range.small) {
        left.low = size.least;
        left.open = false;
    }
    return left;
}

const Key* find_key(std::string_view path, const std::vector<Key>& keys) {
    const std::string pattern = without_indices(path);
    const auto found =
        std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.path == pattern; });
    return found == keys.end() ? nullptr : &*found;
}

std::vector<std::string> rivals_of(std::string_view path, const std::vector<Key>& keys) {
    const std::string pattern = without_indices(path), name = name_of(pattern);
    std::vector<std::string> rivals;
    for (const Key& key : keys) {
        if (parent_of(key.path) != parent_of(pattern)) continue;
        if (key.path == pattern) rivals.insert(rivals.end(), key.excludes.begin(), key.excludes.end());
        const auto& others = key.excludes;
        if (contains(others, name)) rivals.push_back(name_of(key.path));
    }
    return rivals;
}

bool is_table_path(std::string_view path, const std::vector<Key>& keys) {
    const std::string start = without_indices(path) + ".";
    return std::any_of(keys.begin(), keys.end(),
                       [&](const Key& k) { return k.path.compare(0, start.size(), start) == 0; });
}

bool is_table_array_path(std::string_view path, const std::vector<Key>& keys) {
    return is_table_path(std::string(path) + "[]", keys);
}

std::string table_of(std::string_view path) {
    return heading_of(parent_of(without_indices(path)));
}

namespace {

// What users call a key of a table, where another table has a key of that name which means something else.
struct OtherName {
    const char *table, *name, *key;
};
constexpr OtherName other_names[] = {{"drive", "gamma", "g_level"},
                                     {"drive", "Gamma", "g_level"},
                                     {"drive", "Γ", "g_level"},
                                     {"drive", "acceleration", "g_level"}};

std::optional<std::string> meant_by(const std::string& table, const std::string& name) {
    for (const OtherName& other : other_names)
        if ((table == other.table || table == std::string(other.table) + ".stage[]") && name == other.name)
            return other.key;
    return std::nullopt;
}

// The table inside another one that has this name: "container.outlet" for "outlet".
std::optional<std::string> table_named(const std::string& name, const std::vector<Key>& keys) {
    for (const Key& key : keys)
        for (std::string table = parent_of(key.path); table.find('.') != std::string::npos;
             table = parent_of(table))
            if (name_of(table) == name) return table;
    return std::nullopt;
}

}  // namespace

std::string advice_for_unknown_key(std::string_view path, const std::vector<Key>& keys) {
    const std::string name = name_of(without_indices(path));
    const std::vector<std::string> here = names_inside(parent_of(without_indices(path)), keys);
    if (const auto meant = meant_by(parent_of(without_indices(path)), name))
        return fmt::format("did you mean '{}'?", *meant);
    if (const auto table = table_named(name, keys)) return fmt::format("did you mean '{}'?", *table);
    if (const std::optional<std::string> nearest = nearest_name(name, here))
        return fmt::format("did you mean '{}'?", *nearest);
    for (const Key& key : keys)
        if (name_of(key.path) == name) return fmt::format("it belongs in {}", table_of(key.path));
    return fmt::format("the keys there are {}", fmt::join(here, ", "));
}

std::string key_table_markdown(const std::vector<Key>& keys) {
    std::string text;
    std::string table = "none yet";
    for (const Key& key : keys) {
        std::string inside = parent_of(key.path);
        std::string name = name_of(key.path);
        if (find_key(inside, keys) != nullptr) {  // a value that may be a table
            name = name_of(inside) + "." + name;
            inside = parent_of(inside);
        }
        if (inside != table) {
            table = inside;
            text += fmt::format("\n### {}\n\n| key | value | default | meaning |\n|---|---|---|---|\n",
                                inside.empty() ? "At the top level" : "`" + heading_of(inside) + "`");
        }
        std::string value = value_words(key);
        if (const std::string range = key.range.text(); !range.empty() && range != "finite")
            value += ", " + range;
        if (key.range.infinite) value += ", or inf";
        const std::string fallback = key.fallback.empty() ? key.fallback_note : "`" + key.fallback + "`";
        text += fmt::format("| `{}` | {} | {} | {} |\n", name, value, fallback, key.about);
    }
    return text;
}

std::string Assignment::key() const {
    return std::string(trimmed(text.substr(0, text.find('=')), " \t"));
}

std::string Assignment::value() const {
    const auto equals = text.find('=');
    return equals == std::string::npos ? "" : std::string(trimmed(text.substr(equals + 1), " \t"));
}

std::string Assignment::place() const {
    return option.empty() ? "--set " + excerpt(key()) : option;
}

}  // namespace grainreel
