#include "engine/measure/flow/velocity_grid.hpp"

#include <cmath>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

// Around the square whose corners are the middles of cell (j, k) and its neighbours to the right and above.
double around_square(const VelocityGrid& g, std::size_t j, std::size_t k) {
    const std::size_t a = g.index(j, k), b = g.index(j + 1, k), c = g.index(j + 1, k + 1),
                      d = g.index(j, k + 1);
    return 0.5 * g.width * (g.right[a] + g.right[b] - g.right[c] - g.right[d]) +
           0.5 * g.height * (g.up[b] + g.up[c] - g.up[d] - g.up[a]);
}

// Which squares lie between four filled cells, in a range of y.
class Squares {
  public:
    Squares(const VelocityGrid& grid, double from, double to) : grid_(grid), from_(from), to_(to) {}

    // Outside the grid there is none.
    bool there(std::size_t j, std::size_t k) const {
        if (j >= grid_.across - 1 || k >= grid_.high - 1) return false;
        const double slack = 1e-9 * grid_.width;
        if (grid_.y(j) < from_ - slack || grid_.y(j + 1) > to_ + slack) return false;
        return grid_.weight[grid_.index(j, k)] > 0 && grid_.weight[grid_.index(j + 1, k)] > 0 &&
               grid_.weight[grid_.index(j, k + 1)] > 0 && grid_.weight[grid_.index(j + 1, k + 1)] > 0;
    }
    // m, of its sides that no other square shares. 0 - 1 is a large number, and outside.
    double free_sides(std::size_t j, std::size_t k) const {
        return (there(j - 1, k) ? 0 : grid_.height) + (there(j + 1, k) ? 0 : grid_.height) +
               (there(j, k - 1) ? 0 : grid_.width) + (there(j, k + 1) ? 0 : grid_.width);
    }

  private:
    const VelocityGrid& grid_;
    const double from_, to_;  // m
};

// Mean weight of the filled cells.
double mean_weight(const VelocityGrid& grid) {
    double sum = 0, filled = 0;
    for (const double w : grid.weight) {
        sum += w;
        filled += w > 0;
    }
    return filled > 0 ? sum / filled : 0;
}

}  // namespace

Circulation circulation(const VelocityGrid& grid, double from, double to) {
    const Squares squares(grid, from, to);
    Circulation sum;
    for (std::size_t k = 0; k < grid.high; ++k) {
        for (std::size_t j = 0; j < grid.across; ++j) {
            if (!squares.there(j, k)) continue;
            sum.along += around_square(grid, j, k);
            sum.edge += squares.free_sides(j, k);
            sum.area += grid.width * grid.height;
        }
    }
    return sum;
}

std::vector<double> stream_function(const VelocityGrid& grid) {
    std::vector<double> psi(grid.weight.size(), 0);
    const double mean = mean_weight(grid);
    if (mean == 0) return psi;
    for (std::size_t k = 0; k < grid.high; ++k) {
        double flow = 0, weight = 0;
        for (std::size_t j = 0; j < grid.across; ++j) {
            flow += grid.weight[grid.index(j, k)] * grid.up[grid.index(j, k)];
            weight += grid.weight[grid.index(j, k)];
        }
        const double left_over = weight > 0 ? flow / weight : 0;
        double sum = 0;
        for (std::size_t j = 0; j < grid.across; ++j) {
            const std::size_t i = grid.index(j, k);
            sum -= grid.weight[i] / mean * (grid.up[i] - left_over) * grid.width;
            psi[i] = sum;
        }
    }
    return psi;
}

RollCentre roll_centre(const VelocityGrid& grid, const std::vector<double>& psi, double from, double to) {
    GRAINREEL_CHECK(psi.size() == grid.weight.size());
    RollCentre centre;
    for (std::size_t k = 0; k < grid.high; ++k) {
        for (std::size_t j = 0; j < grid.across; ++j) {
            const double y = grid.y(j) + 0.5 * grid.width, here = psi[grid.index(j, k)];
            if (y < from || y > to || std::abs(here) <= std::abs(centre.psi)) continue;
            centre = {y, grid.z(k), here};
        }
    }
    return centre;
}

}  // namespace grainreel
