#include "engine/files/foreign/dumps/dump_box.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/text.hpp"
#include "engine/mesh/file/words.hpp"

namespace grainreel {

WorldCell cell_of(const BoxBounds& b) {
    const auto [x_least, x_most] = std::minmax({0.0, b.xy, b.xz, b.xy + b.xz});
    const auto [y_least, y_most] = std::minmax({0.0, b.yz});
    WorldCell cell;
    cell.origin = Vec3(b.low[0] - x_least, b.low[1] - y_least, b.low[2]);
    const double x_high = b.high[0] - x_most, y_high = b.high[1] - y_most;
    cell.edges = {Vec3(x_high - cell.origin.x(), 0, 0), Vec3(b.xy, y_high - cell.origin.y(), 0),
                  Vec3(b.xz, b.yz, b.high[2] - b.low[2])};
    cell.periodic = b.periodic;
    return cell;
}

BoxReader::BoxReader(std::string_view flags) {
    Words words(flags);
    std::size_t axis = 0;
    for (std::string_view word = words.next_in_line(); !word.empty(); word = words.next_in_line()) {
        if (word == "xy" || word == "xz" || word == "yz")
            tilted_ = true;
        else if (word == "abc" || word == "origin")
            general_ = true;
        else if (axis < 3)
            periodic_[axis++] = word == "pp" || word == "p";
    }
}

std::size_t BoxReader::wanted() const {
    return general_ ? 4 : tilted_ ? 3 : 2;
}

std::string BoxReader::take(std::string_view line) {
    Words words(line);
    std::array<double, 4>& row = rows_[static_cast<std::size_t>(lines_++)];
    std::size_t count = 0;
    for (std::string_view word = words.next_in_line(); !word.empty(); word = words.next_in_line(), ++count) {
        const std::optional<double> number = number_in(word);
        if (!number) return fmt::format("a number of the box is expected, and {}", no_number(word));
        if (count < row.size()) row[count] = *number;
    }
    // Some programs write tilts and do not name them.
    if (lines_ == 1 && count == 3) tilted_ = !general_;
    if (count != wanted()) return fmt::format("the box has {} numbers in this line, of {}", count, wanted());
    return "";
}

std::string BoxReader::finish(bool empty) {
    if (general_) {
        WorldCell cell;
        for (std::size_t k = 0; k < 3; ++k) {
            cell.edges[k] = Vec3(rows_[k][0], rows_[k][1], rows_[k][2]);
            cell.origin[static_cast<Eigen::Index>(k)] = rows_[k][3];
        }
        cell.periodic = periodic_;
        box_ = cell;
        return "";
    }
    BoxBounds bounds;
    for (std::size_t k = 0; k < 3; ++k) {
        bounds.low[k] = rows_[k][0];
        bounds.high[k] = rows_[k][1];
        if (bounds.high[k] < bounds.low[k]) {
            if (empty) return "";
            return fmt::format("the box ends before it begins along {}: from {:g} to {:g}", "xyz"[k],
                               bounds.low[k], bounds.high[k]);
        }
    }
    if (tilted_) {
        bounds.xy = rows_[0][2];
        bounds.xz = rows_[1][2];
        bounds.yz = rows_[2][2];
    }
    bounds.periodic = periodic_;
    box_ = cell_of(bounds);
    return "";
}

}  // namespace grainreel
