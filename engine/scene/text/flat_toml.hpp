// A TOML document as a list of keys and values, one below the other: the full table of a run's parameters.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace grainreel {

// Path and value of each key, "contact.pair[1].friction" and "0.5", in the document's order of names. Text
// has no quotes; a list of plain values is one value, "[1, 2]". The text must be TOML.
std::vector<std::pair<std::string, std::string>> flat_toml(std::string_view text);

}  // namespace grainreel
