#include "engine/files/foreign/dumps/old_columns.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/files/foreign/dumps/text_head.hpp"
#include "engine/files/foreign/dumps/text_rows.hpp"
#include "engine/mesh/file/words.hpp"

namespace grainreel {
namespace {

std::size_t words_in(std::string_view text) {
    Words words(text);
    std::size_t count = 0;
    while (!words.next_in_line().empty()) ++count;
    return count;
}

// Grains may be a little outside a periodic box between two steps of its lists.
constexpr double outside = 0.02;

bool scaled(const RawTable& table, const std::optional<WorldCell>& box) {
    bool in_box = true, wide = false;
    double room = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::vector<double>& values = table.columns[2 + k].values;
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        if (*least < -outside || *most > 1 + outside) return false;
        if (*most - *least > 0.5) wide = true;
        const auto axis = static_cast<Eigen::Index>(k);
        const double low = box ? box->origin[axis] : 0, size = box ? box->edges[k][axis] : 0;
        room *= size;
        if (*least < low - outside * size || *most > low + (1 + outside) * size) in_box = false;
    }
    // A bed of millimetres in a box of centimetres lies within 0 and 1 too. Of two readings that are both
    // possible that one holds by which the grains fill more of the box.
    return wide || !in_box || room > 1;
}

}  // namespace

OldColumns old_columns(LineReader& lines, const std::filesystem::path& file, const DumpFrame& frame) {
    OldColumns columns;
    lines.seek(frame.place, frame.line);
    DumpHead head;
    TextLine line;
    if (read_head(lines, file, head) != HeadEnd::whole || !lines.next_with_words(line)) return columns;
    const std::size_t width = words_in(line.text);
    for (std::size_t k = 0; k < width; ++k) columns.names.push_back(fmt::format("c{}", k + 1));
    columns.words = fmt::format("does not name its {} columns; they are called c1 to c{}", width, width);
    if (width != 5 && width != 8) return columns;

    lines.seek(head.rows_place, head.rows_line);
    const RawTable table =
        read_rows(lines, file, {columns.names, frame.rows, frame.end - head.rows_place, false});
    columns.names = {"id", "type", "x", "y", "z"};
    if (scaled(table, head.box))
        for (std::size_t k = 2; k < 5; ++k) columns.names[k] += 's';
    if (width == 8) columns.names.insert(columns.names.end(), {"ix", "iy", "iz"});
    columns.words = fmt::format("does not name its columns; taken as {}, as old dumps have them",
                                fmt::join(columns.names, " "));
    return columns;
}

}  // namespace grainreel
