// Columns of RawTable out of VTK's arrays.
#pragma once

#include <string>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/foreign/vtk/vtk_piece.hpp"

namespace grainreel {

// Which tuples of the arrays are rows of a table: all in their order, or those listed. kNoTuple: a row of
// NaN.
struct VtkRows {
    std::size_t count = 0;
    bool all = true;
    std::vector<std::size_t> tuples{};
};
inline constexpr std::size_t kNoTuple = static_cast<std::size_t>(-1);

// Columns under the arrays' names, "v:0", "v:1", "v:2" of vectors.
std::vector<RawColumn> columns_of(std::vector<VtkArray>&& arrays, const VtkRows& rows);
// The columns "x", "y", "z" (with the tail, "1" gives "x1") of points.
std::vector<RawColumn> place_columns(const std::vector<double>& places, const VtkRows& rows,
                                     const char* tail);

// Adds rows. Throws UserError where the table has rows already, and other columns than these.
void add_rows(RawTable& table, std::vector<RawColumn>&& columns, std::size_t rows, const std::string& where);

}  // namespace grainreel
