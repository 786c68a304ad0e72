#include "engine/step/grid/cells.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace grainreel {

namespace {

constexpr double kMostBoxesPerGrain = 8;  // empty space must not cost memory or time
constexpr std::size_t kFew = 4;  // a level has few grains if it has less than one of so many grains of the
                                 // bed

}  // namespace

void Grid::lay(const LargeArray<Place>& place, const std::vector<std::int32_t>& members, double width,
               const GridLayout& frame) {
    const std::size_t n = members.size();
    periodic_ = frame.period > 0;
    axes_ = frame.axes;
    const auto along = [&](const Vec3& v) { return Vec3(v[axes_[0]], v[axes_[1]], v[axes_[2]]); };
    const Vec3 size = along(frame.high - frame.low);
    const double most = kMostBoxesPerGrain * static_cast<double>(frame.grains) + 64;
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
    origin_ = along(frame.low);
    width_ = width;
    tile_bits_ = frame.grains < kLargeBed ? kOneTileBits : kTileBits;
    is_near_.clear();

    const std::int64_t total = static_cast<std::int64_t>(count_[0]) * count_[1] * count_[2];
    start_.assign(total + 1, 0);
    box_.resize(n);
    for (std::size_t m = 0; m < n; ++m) {
        box_[m] = static_cast<std::int32_t>(box_of(place[members[m]].position));
        ++start_[box_[m]];
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    in_order_.resize(n);
    for (std::size_t m = n; m-- > 0;) in_order_[--start_[box_[m]]] = members[m];
}

void Grid::keep(const std::vector<std::int32_t>& members) {
    const bool all_stay = members.size() == in_order_.size();
    in_order_ = members;
    if (all_stay) return;  // the starts of the boxes do not change
    std::int32_t before = 0;
    for (std::int32_t& start : start_) {
        while (before < std::ssize(members) && members[before] < start) ++before;
        start = before;
    }
}

void Grid::mark_surroundings(const LargeArray<Place>& place, const std::vector<std::int32_t>& members) {
    if (periodic_) return;
    is_near_.assign(start_.size() - 1, false);
    for (const std::int32_t i : members) {
        const auto around = [&](int a) {
            const int own = box_of(place[i].position, a);
            return std::array<int, 2>{std::max(own - 1, 0), std::min(own + 1, count_[a] - 1)};
        };
        const std::array<int, 2> x = around(0), y = around(1), z = around(2);
        for (int at_z = z[0]; at_z <= z[1]; ++at_z)
            for (int at_y = y[0]; at_y <= y[1]; ++at_y)
                for (int at_x = x[0]; at_x <= x[1]; ++at_x) is_near_[index(at_x, at_y, at_z)] = true;
    }
}

// Makes one level for each octave of radii, from the smallest up.
void Cells::find_levels(const LargeArray<Place>& place) {
    double smallest = std::numeric_limits<double>::infinity(), largest_of_all = 0;
    for (const Place& p : place) {
        smallest = std::min(smallest, p.radius);
        largest_of_all = std::max(largest_of_all, p.radius);
    }
    if (largest_of_all < 2 * smallest) {
        levels_.resize(1);
        levels_[leading_ = 0].largest = largest_of_all;
        return;
    }
    std::array<double, kOctaves> largest{};
    std::array<std::size_t, kOctaves> count{};
    octave_of_.resize(place.size());
    for (std::size_t i = 0; i < place.size(); ++i) {
        const double radius = place[i].radius;
        const int octave = radius < 2 * smallest ? 0 : std::min(std::ilogb(radius / smallest), kOctaves - 1);
        octave_of_[i] = static_cast<std::uint8_t>(octave);
        largest[octave] = std::max(largest[octave], radius);
        ++count[octave];
    }
    levels_.resize(kOctaves - std::count(count.begin(), count.end(), 0u));
    std::size_t level = 0, most = 0;
    for (int octave = 0; octave < kOctaves; ++octave) {
        if (count[octave] == 0) continue;
        if (count[octave] > most) most = count[octave], leading_ = level;
        level_of_[octave] = static_cast<std::uint8_t>(level);
        levels_[level++].largest = largest[octave];
    }
}

// Finds the members of each level, by their new indices.
void Cells::find_members() {
    if (levels_.size() == 1) {
        levels_[0].members.resize(in_order().size());
        std::iota(levels_[0].members.begin(), levels_[0].members.end(), 0);
        return;
    }
    for (Level& level : levels_) level.members.clear();
    const std::vector<std::int32_t>& order = in_order();
    for (std::size_t i = 0; i < order.size(); ++i)
        levels_[level_of_[octave_of_[order[i]]]].members.push_back(static_cast<std::int32_t>(i));
}

namespace {

GridLayout frame_of(const LargeArray<Place>& place, double period) {
    GridLayout frame{place[0].position, place[0].position, place.size(), {0, 1, 2}, period};
    for (const Place& p : place) {
        frame.low = frame.low.cwiseMin(p.position);
        frame.high = frame.high.cwiseMax(p.position);
    }
    if (period > 0) {
        frame.low.x() = -period / 2;
        frame.high.x() = period / 2;
        return frame;
    }
    const Vec3 size = frame.high - frame.low;
    std::sort(frame.axes.begin(), frame.axes.end(),
              [&](int a, int b) { return std::tuple(size[a], a) < std::tuple(size[b], b); });
    return frame;
}

}  // namespace

void Cells::order(const LargeArray<Place>& place, double skin, double period) {
    find_levels(place);
    frame_ = frame_of(place, period);
    Level& leading = levels_[leading_];
    leading.members.resize(place.size());  // all grains, until lay()
    std::iota(leading.members.begin(), leading.members.end(), 0);
    leading.grid.lay(place, leading.members, 2 * leading.largest + skin, frame_);
}

void Cells::lay(const LargeArray<Place>& place, double skin) {
    find_members();
    for (Level& level : levels_) {
        level.leads = &level == &levels_[leading_];
        if (level.leads)
            level.grid.keep(level.members);
        else
            level.grid.lay(place, level.members, 2 * level.largest + skin, frame_);
        level.rising = level.grid.in_order() == level.members;
        if (level.members.size() < place.size() / kFew) level.grid.mark_surroundings(place, level.members);
    }
}

}  // namespace grainreel
