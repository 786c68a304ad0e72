// Searches in short lists.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>

namespace grainreel {

template <class List, class Value>
bool contains(const List& list, const Value& value) {
    return std::find(std::begin(list), std::end(list), value) != std::end(list);
}

// The place of the first such value, from 0; none where the list does not have it.
template <class List, class Value>
std::optional<std::size_t> place_in(const List& list, const Value& value) {
    const auto found = std::find(std::begin(list), std::end(list), value);
    if (found == std::end(list)) return std::nullopt;
    return static_cast<std::size_t>(std::distance(std::begin(list), found));
}

}  // namespace grainreel
