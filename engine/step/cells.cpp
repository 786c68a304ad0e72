#include "engine/step/cells.hpp"

#include <algorithm>
#include <cmath>

namespace grainreel {

namespace {

constexpr double kMostBoxesPerGrain = 8;  // an empty tall container must not cost memory or time

}  // namespace

void Cells::lay(const std::vector<Place>& place, double width, double period) {
    const std::size_t n = place.size();
    Vec3 low = place[0].position, high = low;
    for (const Place& p : place) {
        low = low.cwiseMin(p.position);
        high = high.cwiseMax(p.position);
    }
    periodic_ = period > 0;
    if (periodic_) {
        low.x() = -period / 2;
        high.x() = period / 2;
    }
    const Vec3 size = high - low;
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
    origin_ = low;

    const std::int64_t total = index(0, 0, count_[2]);
    start_.assign(total + 1, 0);
    box_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const auto b = box_of(place[i].position);
        box_[i] = static_cast<std::int32_t>(index(b[0], b[1], b[2]));
        ++start_[box_[i] + 1];
    }
    for (std::int64_t b = 0; b < total; ++b) start_[b + 1] += start_[b];
    order_.resize(n);
    std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < n; ++i) order_[next[box_[i]]++] = static_cast<std::int32_t>(i);
}

std::array<int, 3> Cells::box_of(const Vec3& position) const {
    std::array<int, 3> box{};
    for (int a = 0; a < 3; ++a) {
        box[a] =
            std::clamp(static_cast<int>((position[a] - origin_[a]) * inverse_width_[a]), 0, count_[a] - 1);
    }
    return box;
}

int Cells::partners_after(const Vec3& position, std::int32_t i, std::array<Range, 14>& ranges) const {
    const auto [x, y, z] = box_of(position);
    int found = 0;
    const auto add = [&](int x0, int x1, int row_y, int row_z) {
        const std::int32_t first = std::max(start_[index(x0, row_y, row_z)], i + 1);
        const std::int32_t last = start_[index(x1, row_y, row_z) + 1];
        if (first < last) ranges[found++] = {first, last};
    };
    const int x0 = std::max(x - 1, 0), x1 = std::min(x + 1, count_[0] - 1);
    for (int dz = 0; dz <= 1; ++dz) {
        if (z + dz >= count_[2]) continue;
        for (int dy = dz == 0 ? 0 : -1; dy <= 1; ++dy) {
            if (y + dy < 0 || y + dy >= count_[1]) continue;
            add(x0, x1, y + dy, z + dz);
            if (!periodic_ || count_[0] < 3) continue;  // with fewer boxes x-1 .. x+1 are all there are
            if (x == 0) add(count_[0] - 1, count_[0] - 1, y + dy, z + dz);
            if (x == count_[0] - 1) add(0, 0, y + dy, z + dz);
        }
    }
    return found;
}

}  // namespace grainreel
