// Lists in a document: intervals, names, whole numbers, values of any kind.
#include <fmt/format.h>

#include <sstream>

#include "engine/scene/keys/document.hpp"
#include "engine/scene/text/toml_text.hpp"

namespace grainreel {
namespace {

// In one line, and read back to the same bits.
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

}  // namespace

std::optional<std::array<double, 2>> Document::interval(const std::string& path, Dimension dimension) {
    const toml::node* node = read(path);
    if (node == nullptr) return std::nullopt;
    Key end = *find_key(path, *keys_);
    end.kind = KeyKind::quantity;
    end.dimension = dimension;
    const toml::array* array = node->as_array();
    if (array == nullptr || array->size() != 2)
        fail(path, fmt::format("must be two values, [low, high], but is {0}; write for example [{1}, {1}]",
                               written_value(*node), text_of(dimension).example));
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
