// The second line of a frame of XYZ: words of any kind, or in extended XYZ (libAtoms' extxyz) keys with
// values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/frames/stored_world.hpp"

namespace grainreel {

// One entry of Properties, "velo:R:3": `count` columns of a kind.
struct XyzField {
    std::string name;
    char kind = 'R';  // as in extended XYZ: S word, R real, I whole number, L logical
    std::size_t count = 1;
};

// The second line of a frame: words of any kind, or in extended XYZ keys with values.
struct XyzHeader {
    std::vector<XyzField> fields;  // empty for plain XYZ, where the first row tells them
    std::optional<WorldCell> box;
    std::optional<double> time;
    std::optional<std::int64_t> step;
};

// Whether the line is one of extended XYZ, which has Properties or a Lattice.
bool is_extended_xyz(std::string_view line);

// Reads the second line of a frame. Throws UserError that says what is wrong with the line; the caller adds
// the name of the file.
XyzHeader xyz_header_of(std::string_view line);

}  // namespace grainreel
