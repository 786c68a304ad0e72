// The second line of a frame of XYZ: words of any kind, or in extended XYZ keys with values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/frames/world.hpp"

namespace grainreel {

// One entry of Properties, "velo:R:3": `count` columns of a kind.
struct XyzField {
    std::string name;
    char kind = 'R';  // S word, R real, I whole, L logical, as extended XYZ has them
    std::size_t count = 1;
};

struct XyzHeader {
    std::vector<XyzField> fields;  // empty for plain XYZ, whose first row tells them
    std::optional<WorldCell> box;
    std::optional<double> time;
    std::optional<std::int64_t> step;
};

struct XyzEntry {
    std::string key;                   // in lower case
    std::optional<std::string> value;  // none for a key that stands alone
};

// The entries of a line: blanks may stand around "=", values in "", '', {} or [].
std::vector<XyzEntry> xyz_entries(std::string_view line);

// Whether the line is one of extended XYZ: whether it has Properties.
bool is_extended_xyz(std::string_view line);

// Throws UserError without a file's name: what is wrong with the line.
XyzHeader xyz_header_of(std::string_view line);

}  // namespace grainreel
