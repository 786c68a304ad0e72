// The rows of a frame of a text dump, as numbers. This is where the time goes that reading takes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/files/foreign/dumps/line_reader.hpp"
#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

struct RowsToRead {
    std::vector<std::string> names;  // of the columns
    std::int64_t rows = 0;
    std::uint64_t bytes = 0;  // of all rows together, at most; bounds the memory that is asked for
    bool pairs = false;       // no grains: nothing is known of what the columns mean
};

// From where `lines` stands. Throws UserError with the line of a row that has too few or too many fields,
// that has a word where a number must be, or an id, a place or a radius that is no finite number.
RawTable read_rows(LineReader& lines, const std::filesystem::path& file, const RowsToRead& wanted);

}  // namespace grainreel
