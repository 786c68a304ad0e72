#include "engine/scene/text/flat_toml.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>
#include <algorithm>

namespace grainreel {
namespace {

using Flat = std::vector<std::pair<std::string, std::string>>;

std::string words_of_node(const toml::node& node) {
    if (const auto text = node.value_exact<std::string>()) return *text;
    if (const auto whole = node.value_exact<std::int64_t>()) return fmt::format("{}", *whole);
    if (const auto number = node.value_exact<double>()) return fmt::format("{}", *number);
    if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
    const toml::array* list = node.as_array();
    if (list == nullptr) return "";
    std::string all;
    for (const toml::node& element : *list) all += (all.empty() ? "" : ", ") + words_of_node(element);
    return "[" + all + "]";
}

void add(const toml::node& node, const std::string& path, Flat& flat) {
    if (const toml::table* table = node.as_table()) {
        for (const auto& [key, value] : *table)
            add(value, path.empty() ? std::string(key.str()) : path + "." + std::string(key.str()), flat);
        return;
    }
    const toml::array* list = node.as_array();
    const bool of_tables =
        list != nullptr && !list->empty() &&
        std::all_of(list->begin(), list->end(), [](const toml::node& one) { return one.is_table(); });
    if (!of_tables) {
        flat.emplace_back(path, words_of_node(node));
        return;
    }
    for (std::size_t i = 0; i < list->size(); ++i) add((*list)[i], fmt::format("{}[{}]", path, i), flat);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> flat_toml(std::string_view text) {
    Flat flat;
    add(toml::parse(text), "", flat);
    return flat;
}

}  // namespace grainreel
