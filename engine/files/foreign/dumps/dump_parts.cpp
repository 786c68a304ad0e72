#include "engine/files/foreign/dumps/dump_parts.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/base/number_text.hpp"
#include "engine/base/word_reader.hpp"

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
    WordReader words(flags);
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
    WordReader words(line);
    std::array<double, 4>& row = rows_[lines_++];
    std::size_t count = 0;
    for (std::string_view word = words.next_in_line(); !word.empty(); word = words.next_in_line(), ++count) {
        const std::optional<double> number = number_in(word);
        if (!number) return fmt::format("a number of the box is expected, and {}", no_number(word));
        if (count < row.size()) row[count] = *number;
    }
    // Some programs write tilts without naming them.
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

namespace {

using Values = std::vector<double>;

// Finds an id that comes twice, with one bit for each possible id.
std::optional<BadId> doubled_among_near(const Values& ids, double least, double span) {
    std::vector<bool> seen(static_cast<std::size_t>(span) + 1);
    for (std::size_t row = 0; row < ids.size(); ++row) {
        const auto k = static_cast<std::size_t>(ids[row] - least);
        if (seen[k]) return BadId{row, ids[row]};
        seen[k] = true;
    }
    return std::nullopt;
}

// Finds such an id by sorting, where ids are spread too widely for a table of bits.
std::optional<BadId> doubled_among_far(const Values& ids) {
    std::vector<std::pair<double, std::size_t>> sorted(ids.size());
    for (std::size_t row = 0; row < ids.size(); ++row) sorted[row] = {ids[row], row};
    std::sort(sorted.begin(), sorted.end());
    const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
    const auto doubled = std::adjacent_find(sorted.begin(), sorted.end(), same);
    if (doubled == sorted.end()) return std::nullopt;
    return BadId{std::next(doubled)->second, doubled->first};
}

}  // namespace

bool must_be_finite(const std::string& column) {
    constexpr std::array names{"id", "x",  "y",   "z",   "xs",  "ys",     "zs",      "xu",
                               "yu", "zu", "xsu", "ysu", "zsu", "radius", "diameter"};
    return std::any_of(names.begin(), names.end(), [&](const char* name) { return same_word(column, name); });
}

std::string BadId::words() const {
    if (id != std::floor(id)) return fmt::format("the id {:g} is no whole number", id);
    return fmt::format(
        "the id {:.0f} stands in this frame for the second time; each grain needs an id of its own", id);
}

std::optional<BadId> bad_id(const RawTable& grains) {
    const RawColumn* const column = grains.find("id");
    if (column == nullptr || grains.rows == 0) return std::nullopt;
    const Values& ids = column->values;
    const auto broken =
        std::find_if(ids.begin(), ids.end(), [](double id) { return !(id == std::floor(id)); });
    if (broken != ids.end()) return BadId{static_cast<std::size_t>(broken - ids.begin()), *broken};
    const auto [least, most] = std::minmax_element(ids.begin(), ids.end());
    const double span = *most - *least;
    constexpr double bits_a_grain = 32;
    return span < bits_a_grain * static_cast<double>(ids.size()) ? doubled_among_near(ids, *least, span)
                                                                 : doubled_among_far(ids);
}

}  // namespace grainreel
