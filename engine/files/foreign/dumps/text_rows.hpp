// Turns the rows of a dump's frame into numbers. Reading a dump spends most of its time here;
// engine/CMakeLists.txt compiles text_rows.cpp with -O3.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/files/foreign/bytes/line_reader.hpp"
#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

struct RowsToRead {
    std::vector<std::string> names;  // names of the columns
    std::int64_t rows = 0;
    std::uint64_t bytes = 0;  // most bytes of all rows together; limits the memory that is asked for
    bool pairs = false;       // the rows are not grains, and the columns can be anything
};

// Reads the rows from where `lines` stands. Throws UserError with the line of a row that has too few or too
// many fields, a word in place of a number, or an id, a place or a radius that is not finite.
RawTable read_rows(LineReader& lines, const std::filesystem::path& file, const RowsToRead& wanted);

}  // namespace grainreel
