// The columns of the section "Atoms" in a data file of LAMMPS or LIGGGHTS. They depend on the atom_style,
// which the file may not say. A further style with spheres is added in data_columns.cpp.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace grainreel {

// Places of the columns that are read, from 0.
struct DataColumns {
    std::string style;                                               // "sphere", "hybrid sphere bond"
    bool guessed = false;                                            // the file does not say the style
    std::size_t id = 0, type = 1, diameter = 2, density = 3, x = 4;  // y and z follow x
    std::size_t least = 7;                                           // columns that a row has at least
};

// rows: the words of some rows, from which the style is guessed where `style` is empty. types: how many types
// the file has. complaint: what is wrong, if the style has no spheres or cannot be told; else empty.
DataColumns data_columns(std::string_view style, const std::vector<std::vector<std::string_view>>& rows,
                         std::size_t types, std::string& complaint);

}  // namespace grainreel
