#include "engine/step/cells.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace grainreel {

namespace {

constexpr double kMostBoxesPerGrain = 8;  // an empty tall container must not cost memory or time

}  // namespace

void Grid::lay(const LargeArray<Place>& place, const std::vector<std::int32_t>& members, double width,
               const std::array<int, 3>& axes, double period) {
    const std::size_t n = members.size();
    Vec3 low = place[members[0]].position, high = low;
    for (const std::int32_t i : members) {
        low = low.cwiseMin(place[i].position);
        high = high.cwiseMax(place[i].position);
    }
    periodic_ = period > 0;
    if (periodic_) {
        low.x() = -period / 2;
        high.x() = period / 2;
    }
    axes_ = axes;
    const auto along = [&](const Vec3& v) { return Vec3(v[axes[0]], v[axes[1]], v[axes[2]]); };
    const Vec3 size = along(high - low);
    const double most = kMostBoxesPerGrain * static_cast<double>(n) + 64;
    const auto boxes = [&](double w) {
        double product = 1;
        for (int a = 0; a < 3; ++a) product *= std::max(1.0, std::floor(size[a] / w));
        return product;
    };
    while (boxes(width) > most) width *= 1.26;
    for (int a = 0; a < 3; ++a) {
        count_[a] = std::max(1, static_cast<int>(size[a] / width));
        inverse_width_[a] = size[a] > 0 ? count_[a] / size[a] : 0.0;
    }
    origin_ = along(low);
    tile_bits_ = n < kLargeBed ? kOneTileBits : kTileBits;

    const std::int64_t total = static_cast<std::int64_t>(count_[0]) * count_[1] * count_[2];
    start_.assign(total + 1, 0);
    box_.resize(n);
    for (std::size_t m = 0; m < n; ++m) {
        box_[m] = box_of(place[members[m]].position);
        ++start_[box_[m]];
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    in_order_.resize(n);
    for (std::size_t m = n; m-- > 0;) in_order_[--start_[box_[m]]] = members[m];
}

std::int32_t Grid::box_of(const Vec3& position) const {
    std::array<int, 3> at{};
    for (int a = 0; a < 3; ++a) at[a] = std::clamp(box(position[axes_[a]] - origin_[a], a), 0, count_[a] - 1);
    return static_cast<std::int32_t>(index(at[0], at[1], at[2]));
}

// Octave by octave of radii, from the smallest up.
void Cells::sort_into_levels(const LargeArray<Place>& place) {
    double smallest = std::numeric_limits<double>::infinity(), largest = 0;
    for (const Place& p : place) {
        smallest = std::min(smallest, p.radius);
        largest = std::max(largest, p.radius);
    }
    levels_.resize(std::ilogb(largest / smallest) + 1);
    for (Level& level : levels_) level.members.clear(), level.largest = 0;
    for (std::size_t i = 0; i < place.size(); ++i) {
        Level& level = levels_[levels_.size() > 1 ? std::ilogb(place[i].radius / smallest) : 0];
        level.members.push_back(static_cast<std::int32_t>(i));
        level.largest = std::max(level.largest, place[i].radius);
    }
    std::erase_if(levels_, [](const Level& level) { return level.members.empty(); });
}

const std::vector<std::int32_t>& Cells::order(const LargeArray<Place>& place, double skin, double period) {
    sort_into_levels(place);
    const auto fewer = [](const Level& a, const Level& b) { return a.members.size() < b.members.size(); };
    Level& most = *std::max_element(levels_.begin(), levels_.end(), fewer);
    most.members.resize(place.size());  // all of them, until lay()
    std::iota(most.members.begin(), most.members.end(), 0);
    axes_ = {0, 1, 2};
    if (period == 0) {
        Vec3 low = place[0].position, high = low;
        for (const Place& p : place) low = low.cwiseMin(p.position), high = high.cwiseMax(p.position);
        const Vec3 size = high - low;
        std::sort(axes_.begin(), axes_.end(),
                  [&](int a, int b) { return std::tuple(size[a], a) < std::tuple(size[b], b); });
    }
    most.grid.lay(place, most.members, 2 * most.largest + skin, axes_, period);
    return most.grid.in_order();
}

void Cells::lay(const LargeArray<Place>& place, double skin, double period) {
    sort_into_levels(place);
    for (Level& level : levels_) {
        level.grid.lay(place, level.members, 2 * level.largest + skin, axes_, period);
        level.rising = level.grid.in_order() == level.members;
    }
}

}  // namespace grainreel
