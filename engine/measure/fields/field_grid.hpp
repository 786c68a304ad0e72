// The grid on which fields are given, the kernels of coarse-graining, and the shares of cells inside the
// container. The grid follows the container: places are relative to the present middle of its floor.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/output.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// The cells along one direction.
struct GridAxis {
    double low = 0;   // m, where the first cell begins
    double cell = 0;  // m
    std::int64_t count = 1;
    bool resolved = true;  // false: there is one cell, and fields are means along this direction
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

// The container is filled by whole cells from wall to wall. Beyond each wall there are as many more cells as
// the kernel of the largest grain reaches, because stress is spread beyond the walls too.
FieldGrid make_field_grid(const Scene& scene, const FieldOutput& fields);

// Share of each cell that is inside the container at rest, 0 to 1. If only the floor moves, the container
// begins at the floor's lowest place. Planes of the scene do not cut anything off.
std::vector<double> inside_shares(const FieldGrid& grid, const Scene& scene);

// The kernels of coarse-graining, by which a grain, taken as a point, is spread over its surroundings.
//
// Both kernels are radial, in two or three dimensions, and end at a cutoff. Only their shape matters here: a
// footprint (footprint.hpp) scales the values to a sum of one over the cells of its grid.

// Value of a kernel at a distance of q cutoffs, 0 <= q < 1; it is 1 in the middle.
// Gaussian: exp(-r2 / 2 w2), with its cutoff at 3 w (Weinhart, Hartkamp, Thornton & Luding 2013, Phys. Fluids
// 25, 070605). Lucy (1977, Astron. J. 82, 1013): (1 + 3 q)(1 - q)^3.
double kernel_value(FieldOutput::Kernel kind, double q);

// Width (m) of the kernel for a grain of this radius, where the fields ask for `width`. It is at least the
// radius, because a narrower kernel would give a solid fraction above 1 in the middle of the grain. From half
// a diameter on fields hardly depend on the width (Goldenberg, Atman, Claudin, Combe & Goldhirsch 2006, Phys.
// Rev. Lett. 96, 168001; Weinhart, Hartkamp, Thornton & Luding 2013), so each grain gets a kernel of its own
// size. In density estimation these are called adaptive kernels (Silverman 1986, Density Estimation, section
// 5.3).
inline double kernel_width(double width, double radius) {
    return std::max(width, radius);
}

class FieldKernel {
  public:
    // `width` (m) is the standard deviation along one axis. For the Gaussian it is that of the kernel without
    // the cutoff. `dimensions` is 2 or 3.
    FieldKernel(FieldOutput::Kernel kind, double width, int dimensions);

    double width() const { return width_; }    // m
    double cutoff() const { return cutoff_; }  // m

    // Whether at(a + b) = at(a) at(b) within the cutoff.
    bool is_product() const { return is_product_; }

    // Value at a distance whose square (m2) is given; 0 from the cutoff on. It comes from a table over the
    // square, and is within 2e-5 of the formula.
    double at(double square) const {
        const double exact = square * places_;
        const double place =
            exact < kEntries
                ? exact
                : kEntries + 1.0;  // a selection, not a jump, because both cases are equally frequent
        const auto entry = static_cast<std::size_t>(place);
        const double share = place - static_cast<double>(entry);
        return values_[entry] + share * (values_[entry + 1] - values_[entry]);
    }

  private:
    static constexpr int kEntries = 4096;

    bool is_product_;
    double width_, cutoff_;       // m
    double places_;               // 1/m2, entries of the table per square metre
    std::vector<double> values_;  // the table, with zeros at its end
};

// Does what inside_shares() does, for a vessel that is a mesh.
std::vector<double> shares_inside_mesh(const FieldGrid& grid, const Scene& scene);

}  // namespace grainreel
