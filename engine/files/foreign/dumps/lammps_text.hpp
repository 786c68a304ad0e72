// The columns of dumps that do not name them, as LAMMPS wrote until 2010: "ITEM: ATOMS" and rows of
// id type xs ys zs [ix iy iz].
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/files/foreign/dumps/text_index.hpp"
#include "engine/files/foreign/dumps/text_rows.hpp"

namespace grainreel {

struct OldColumns {
    std::vector<std::string> names{};
    std::string words{};  // how they were found, for the user
};

// By the first frame that has rows. Places are scaled ones, "xs", where they all lie within 0 and 1 (and a
// bit) and would not fit the box as they are. Rows of another width than five and eight get "c1", "c2", ...
OldColumns old_columns(LineReader& lines, const std::filesystem::path& file, const DumpFrame& frame);

}  // namespace grainreel
