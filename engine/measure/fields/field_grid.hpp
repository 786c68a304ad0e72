// The grid on which fields are given. It follows the container: places are counted from where the middle of
// its floor is now.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// The cells along one direction.
struct GridAxis {
    double low = 0;   // m, where the first cell begins
    double cell = 0;  // m
    std::int64_t count = 1;
    bool resolved = true;  // false: one cell that has all, and fields are means along this direction
    bool periodic = false;

    double middle(std::int64_t k) const { return low + (static_cast<double>(k) + 0.5) * cell; }
    std::vector<double> middles() const;
};

struct FieldGrid {
    std::array<GridAxis, 3> axes;  // x, y, z

    std::int64_t cells() const { return axes[0].count * axes[1].count * axes[2].count; }
    // Cells lie in memory with x fastest and z slowest.
    std::int64_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
        return (z * axes[1].count + y) * axes[0].count + x;
    }
    double cell_volume() const { return axes[0].cell * axes[1].cell * axes[2].cell; }  // m3
    int dimensions() const;
};

// The outermost cells inside end at the container's walls, and beyond each wall there are as many more as the
// kernel of the largest grain reaches: stress is spread beyond the walls, too.
FieldGrid make_field_grid(const Scene& scene, const FieldOutput& fields);

// How much of each cell is inside the container at rest, 0 to 1. Where the floor alone moves, the container
// counts from the floor's lowest place. Planes of the scene cut nothing off.
std::vector<double> inside_shares(const FieldGrid& grid, const Scene& scene);

}  // namespace grainreel
