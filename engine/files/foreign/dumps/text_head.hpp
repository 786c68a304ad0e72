// What stands above the rows of one frame of a text dump: "ITEM: TIMESTEP", "ITEM: NUMBER OF ATOMS", ... up
// to "ITEM: ATOMS id type x y z" or, in a dump of pairs, "ITEM: ENTRIES c_1[1] c_1[2]".
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/dumps/text_rows.hpp"
#include "engine/files/frames/world.hpp"

namespace grainreel {

struct DumpHead {
    std::uint64_t place = 0;  // of the first item
    std::int64_t line = 0;
    std::optional<std::int64_t> step{};
    std::optional<double> time{};
    std::string units{};  // empty where the frame does not say
    std::optional<WorldCell> box{};
    std::int64_t rows = 0;
    bool pairs = false;                // a dump local: rows are no grains
    std::vector<std::string> names{};  // of the columns; none in dumps of before 2010
    std::int64_t names_line = 0;
    bool names_ended = true;       // whether a line feed stands behind them
    std::uint64_t rows_place = 0;  // of the first row
    std::int64_t rows_line = 0;
};

enum class HeadEnd {
    whole,    // the rows come next
    nothing,  // the content ended before
    cut       // the content ended within the head
};

// Throws UserError with the line where something stands that is no head. Where the result is cut, `head` has
// what was whole.
HeadEnd read_head(LineReader& lines, const std::filesystem::path& file, DumpHead& head);

}  // namespace grainreel
