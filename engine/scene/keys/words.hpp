// A list of choices: the word that a scene uses for each value.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace grainreel {

template <class T>
using Words = std::vector<std::pair<std::string, T>>;

template <class T>
const std::string& word_of(T value, const Words<T>& words) {
    std::size_t k = 0;
    while (words[k].second != value) ++k;
    return words[k].first;
}

template <class T>
std::vector<std::string> all_of(const Words<T>& words) {
    std::vector<std::string> all;
    for (const auto& word : words) all.push_back(word.first);
    return all;
}

}  // namespace grainreel
