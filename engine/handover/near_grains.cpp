#include "engine/handover/near_grains.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace grainreel {

namespace {

// A sphere, or its image beyond the periodic side, in its cell of a grid. Cells are as wide as the largest
// sphere. A cell's number has 21 bits for each axis; what lies farther away is in the last cells, which loses
// no neighbour.
struct Entry {
    std::uint64_t cell;
    std::int32_t index;
    bool image;
    Vec3 position;  // m
    double radius;  // m
};

constexpr int kBits = 21;
constexpr double kMostCells = (1 << kBits) - 3;
constexpr std::uint64_t kRow = std::uint64_t{1} << kBits, kLayer = kRow << kBits;

std::uint64_t cell_at(const Vec3& place, const Vec3& low, double width) {
    std::array<std::uint64_t, 3> n{};
    for (int k = 0; k < 3; ++k)
        n[static_cast<std::size_t>(k)] =
            1 + static_cast<std::uint64_t>(std::clamp((place[k] - low[k]) / width, 0.0, kMostCells));
    return n[0] + kRow * n[1] + kLayer * n[2];
}

std::vector<Entry> entries_of(const std::vector<Place>& places, double period) {
    double largest = 0;
    Vec3 low = places.front().position;
    for (const Place& place : places) {
        largest = std::max(largest, place.radius);
        low = low.cwiseMin(place.position);
    }
    if (period > 0) low.x() = 0;
    const double width = 2 * largest * (1 + 1e-12);
    std::vector<Entry> all;
    all.reserve(places.size());
    const auto add = [&](std::size_t i, const Vec3& at, bool image) {
        all.push_back({cell_at(at, low, width), static_cast<std::int32_t>(i), image, at, places[i].radius});
    };
    for (std::size_t i = 0; i < places.size(); ++i) {
        Vec3 at = places[i].position;
        if (period > 0) at.x() -= period * std::floor(at.x() / period);
        add(i, at, false);
        if (period > 0 && at.x() < width) add(i, at + Vec3(period, 0, 0), true);
    }
    std::sort(all.begin(), all.end(), [](const Entry& a, const Entry& b) {
        return a.cell != b.cell ? a.cell < b.cell : a.index < b.index;
    });
    return all;
}

}  // namespace

void for_overlapping(const std::vector<Place>& places, double period,
                     const std::function<void(std::int32_t, std::int32_t, double)>& see) {
    if (places.empty()) return;
    const std::vector<Entry> all = entries_of(places, period);
    const auto look = [&](const Entry& one, const Entry& other) {
        if ((one.image && other.image) || one.index == other.index) return;
        const double reach = one.radius + other.radius;
        const double squared = (one.position - other.position).squaredNorm();
        if (squared < reach * reach) see(one.index, other.index, reach - std::sqrt(squared));
    };
    // The cells behind this one: those of the next row and of three rows in the next layer. begin[r] is the
    // first entry of such a row. It only moves forward, because entries are sorted by cell.
    constexpr std::array<std::uint64_t, 4> rows{kRow, kLayer - kRow, kLayer, kLayer + kRow};
    std::array<std::size_t, 4> begin{};
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = i + 1; j < all.size() && all[j].cell <= all[i].cell + 1; ++j)
            look(all[i], all[j]);
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const std::uint64_t middle = all[i].cell + rows[r];
            while (begin[r] < all.size() && all[begin[r]].cell < middle - 1) ++begin[r];
            for (std::size_t j = begin[r]; j < all.size() && all[j].cell <= middle + 1; ++j)
                look(all[i], all[j]);
        }
    }
}

}  // namespace grainreel
