// Lists in a document: intervals, names, whole numbers.
#include <fmt/format.h>

#include "engine/scene/text/document.hpp"

namespace grainreel {

std::optional<std::array<double, 2>> Document::interval(const std::string& path, Dimension dimension) {
    const toml::node* node = read(path);
    if (node == nullptr) return std::nullopt;
    Key end = *find_key(path);
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
                               written_value(*node), find_key(path)->example()));
    return values;
}

std::vector<std::int64_t> Document::integer_list(const std::string& path) {
    const toml::node* node = read(path);
    if (node == nullptr) return {};
    const Key& key = *find_key(path);
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

}  // namespace grainreel
