#include "render/draw/density_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainreel {
namespace {

constexpr int most_cells = 96;  // along one axis; larger beds get larger cells

}  // namespace

void DensityField::place_cells(const Frame& frame) {
    Vec3 low = frame.position[0], high = frame.position[0];
    double smallest = frame.radius[0], largest = frame.radius[0];
    for (std::size_t i = 0; i < frame.size(); ++i) {
        low = low.cwiseMin(frame.position[i]);
        high = high.cwiseMax(frame.position[i]);
        smallest = std::min(smallest, frame.radius[i]);
        largest = std::max(largest, frame.radius[i]);
    }
    const double extent = (high - low).maxCoeff() + 2 * largest;
    cell_ = std::max(2 * smallest, extent / most_cells);
    const double border = largest + 2 * cell_;
    origin_ = low - Vec3::Constant(border);
    for (int axis = 0; axis < 3; ++axis)
        cells_[axis] = static_cast<int>(std::ceil((high[axis] - low[axis] + 2 * border) / cell_)) + 2;
    fraction_.assign(static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2], 0.0f);
}

// Shares a volume, in cells, among the eight nodes around it.
void DensityField::deposit_small(const Vec3& at, double volume) {
    const Vec3 base = at.array().floor();
    const Vec3 share = at - base;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = volume;
        std::size_t index = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const int step = (corner >> axis) & 1;
            weight *= step ? share[axis] : 1 - share[axis];
            index = index * cells_[axis] + static_cast<std::size_t>(base[axis]) + step;
        }
        fraction_[index] += static_cast<float>(weight);
    }
}

// Fills the nodes inside a sphere that is wide against a cell, with a border one cell soft.
void DensityField::deposit_large(const Vec3& at, double radius) {
    std::array<int, 3> first{}, last{};
    for (int axis = 0; axis < 3; ++axis) {
        first[axis] = std::max(0, static_cast<int>(std::floor(at[axis] - radius)));
        last[axis] = std::min(cells_[axis] - 1, static_cast<int>(std::ceil(at[axis] + radius)));
    }
    for (int x = first[0]; x <= last[0]; ++x)
        for (int y = first[1]; y <= last[1]; ++y)
            for (int z = first[2]; z <= last[2]; ++z) {
                const double distance = (Vec3(x, y, z) - at).norm();
                const std::size_t index = (static_cast<std::size_t>(x) * cells_[1] + y) * cells_[2] + z;
                fraction_[index] += static_cast<float>(std::clamp(radius - distance + 0.5, 0.0, 1.0));
            }
}

void DensityField::deposit(const Vec3& centre, double radius) {
    const Vec3 at = (centre - origin_) / cell_;
    const double size = radius / cell_;
    if (size > 0.75)
        deposit_large(at, size);
    else
        deposit_small(at, 4.0 / 3.0 * std::numbers::pi * size * size * size);
}

double DensityField::sample(const Vec3& point) const {
    const Vec3 at = (point - origin_) / cell_;
    std::array<std::size_t, 3> base{};
    Vec3 share;
    for (int axis = 0; axis < 3; ++axis) {
        const double inside = std::clamp(at[axis], 0.0, cells_[axis] - 1.001);
        base[axis] = static_cast<std::size_t>(inside);
        share[axis] = inside - static_cast<double>(base[axis]);
    }
    const auto along_z = [&](std::size_t x, std::size_t y) {
        const float* row = &fraction_[(x * cells_[1] + y) * cells_[2] + base[2]];
        return row[0] + (row[1] - row[0]) * share[2];
    };
    const auto along_y = [&](std::size_t x) {
        const double a = along_z(x, base[1]), b = along_z(x, base[1] + 1);
        return a + (b - a) * share[1];
    };
    const double a = along_y(base[0]), b = along_y(base[0] + 1);
    return a + (b - a) * share[0];
}

const std::vector<Crowding>& DensityField::update(const Frame& frame) {
    crowding_.resize(frame.size());
    if (frame.size() == 0) return crowding_;
    place_cells(frame);
    for (std::size_t i = 0; i < frame.size(); ++i) deposit(frame.position[i], frame.radius[i]);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        // One cell outside the surface: there the grain's own share of the field has died away.
        const double reach = frame.radius[i] + cell_;
        Crowding crowding;
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3 step = reach * Vec3::Unit(axis);
            const double ahead = sample(frame.position[i] + step), behind = sample(frame.position[i] - step);
            crowding.level += (ahead + behind) / 6;
            crowding.slope[axis] = 0.5 * (ahead - behind);
        }
        crowding_[i] = crowding;
    }
    return crowding_;
}

}  // namespace grainreel
