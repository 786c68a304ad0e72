#include "engine/files/foreign/dumps/grain_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/mesh/file/words.hpp"

namespace grainreel {
namespace {

using Values = std::vector<double>;

// A bit for each id that can be.
std::optional<BadId> doubled_among_near(const Values& ids, double least, double span) {
    std::vector<bool> seen(static_cast<std::size_t>(span) + 1);
    for (std::size_t row = 0; row < ids.size(); ++row) {
        const auto k = static_cast<std::size_t>(ids[row] - least);
        if (seen[k]) return BadId{row, ids[row]};
        seen[k] = true;
    }
    return std::nullopt;
}

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
