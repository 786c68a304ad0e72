// Which name somebody meant who mistyped one.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grainreel {

// The nearest of `names` to `word`, by insertions, deletions, substitutions and swaps of neighbours
// (Damerau's distance). Empty when none is near: more than two slips, and more than a third of the word.
std::optional<std::string> nearest_name(std::string_view word, const std::vector<std::string>& names);

}  // namespace grainreel
