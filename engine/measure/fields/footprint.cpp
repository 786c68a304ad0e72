#include "engine/measure/fields/footprint.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/mathematics.hpp"

namespace grainreel {
namespace {

constexpr double longest_stretch = 2.5;  // widths

// Points between 0 and 1 and their weights, of Gauss-Legendre quadrature (Abramowitz & Stegun, table 25.4).
constexpr std::array<std::array<double, 2>, 4> quadrature{
    {{0.5 * (1 - 0.8611363115940526), 0.5 * 0.3478548451374538},
     {0.5 * (1 - 0.3399810435848563), 0.5 * 0.6521451548625461},
     {0.5 * (1 + 0.3399810435848563), 0.5 * 0.6521451548625461},
     {0.5 * (1 + 0.8611363115940526), 0.5 * 0.3478548451374538}}};

// The floor of a value. std::floor() is a function call if the program is built for any processor.
std::int64_t floor_of(double value) {
    const auto towards_zero = static_cast<std::int64_t>(value);
    return towards_zero - (value < static_cast<double>(towards_zero));
}

// The cell of the grid with number k; -1 beyond the grid's edge.
std::int64_t inside(const GridAxis& axis, std::int64_t k) {
    if (k >= 0 && k < axis.count) return k;
    return axis.periodic ? ((k % axis.count) + axis.count) % axis.count : -1;
}

}  // namespace

// All cells whose middles may lie between low and high; all cells if the direction is not resolved.
Footprint::Range Footprint::range_of(std::size_t k, double low, double high) const {
    const GridAxis& axis = grid_.axes[k];
    if (!axis.resolved) return {};
    const double cells = 1 / axis.cell;
    return {floor_of((low - axis.low) * cells), floor_of((high - axis.low) * cells) + 1};
}

// Notes the cells of a box and, axis by axis, the offset that each of them adds to an index of the grid; -1
// beyond the grid's edge.
void Footprint::set_box(const Vec3& low, const Vec3& high) {
    std::int64_t stride = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const int axis = static_cast<int>(k);
        box_[k] = range_of(k, low[axis], high[axis]);
        offsets_[k].resize(box_[k].size());
        std::int64_t cell = box_[k].begin;
        for (std::int64_t& offset : offsets_[k]) {
            const std::int64_t in_grid = inside(grid_.axes[k], cell++);
            offset = in_grid < 0 ? -1 : in_grid * stride;
        }
        stride *= grid_.axes[k].count;
    }
}

// Notes all cells that the kernel reaches on its way from one point to another.
void Footprint::set_box(const Vec3& begin, const Vec3& end, double stretch, double end_stretch) {
    const Vec3 reach = Vec3::Constant(stretch * kernel_.cutoff()),
               end_reach = Vec3::Constant(end_stretch * kernel_.cutoff());
    set_box((begin - reach).cwiseMin(end - end_reach), (begin + reach).cwiseMax(end + end_reach));
}

// Calls each(z, other, begin, end, value) for each row of cells within the cutoff of a point: the indices are
// those in the box, and value(k) is the kernel's value in cell k of the row. The kernel is `stretch` times as
// wide.
template <class Each>
void Footprint::each_near(const Vec3& middle, double stretch, const Each& each) {
    std::array<std::size_t, 3> first{};
    const double reach = stretch * kernel_.cutoff(), shrink = 1 / stretch;
    for (std::size_t k = 0; k < 3; ++k) {
        const double at = middle[static_cast<int>(k)];
        const GridAxis& axis = grid_.axes[k];
        const Range near = range_of(k, at - reach, at + reach);
        first[k] = static_cast<std::size_t>(near.begin - box_[k].begin);
        squares_[k].resize(near.size());
        std::int64_t cell = near.begin;
        for (double& square : squares_[k]) {
            const double away = axis.resolved ? shrink * (axis.middle(cell) - at) : 0;
            square = away * away;
            ++cell;
        }
    }
    const std::vector<double>& squares = squares_[along_];
    if (kernel_.is_product()) {
        factors_.resize(squares.size());
        std::transform(squares.begin(), squares.end(), factors_.begin(),
                       [&](double square) { return kernel_.at(square); });
    }
    const double cutoff = kernel_.cutoff() * kernel_.cutoff();
    for (std::size_t z = 0; z < squares_[2].size(); ++z)
        for (std::size_t other = 0; other < squares_[across_].size(); ++other) {
            const double away = squares_[2][z] + squares_[across_][other];
            std::size_t begin = 0, end = squares.size();
            while (begin < end && away + squares[begin] >= cutoff) ++begin;
            while (begin < end && away + squares[end - 1] >= cutoff) --end;
            const std::size_t row_z = first[2] + z, row_other = first[across_] + other, shift = first[along_];
            if (kernel_.is_product()) {
                const double factor = kernel_.at(away), *const factors = factors_.data();
                each(row_z, row_other, shift + begin, shift + end,
                     [=](std::size_t k) { return factor * factors[k - shift]; });
            } else {
                each(row_z, row_other, shift + begin, shift + end,
                     [&](std::size_t k) { return kernel_.at(away + squares[k - shift]); });
            }
        }
}

// Lists those cells of rows that have a value, and scales the values. rows(add) calls add(z, other, begin,
// end, value) as each_near() does.
template <class Rows>
std::span<const CellWeight> Footprint::listed(const Rows& rows) {
    cells_.resize(std::max(cells_.size(), offsets_[0].size() * offsets_[1].size() * offsets_[2].size()));
    const std::int64_t* const offsets = offsets_[along_].data();
    CellWeight* next = cells_.data();
    double sum = 0;
    rows([&](std::size_t z, std::size_t other, std::size_t begin, std::size_t end, const auto& value) {
        const std::int64_t at_z = offsets_[2][z], at_other = offsets_[across_][other];
        for (std::size_t k = begin; k < end; ++k) {
            const double here = value(k);
            if (here <= 0) continue;
            sum += here;
            if ((at_z | at_other | offsets[k]) >= 0) *next++ = {at_z + at_other + offsets[k], here};
        }
    });
    const std::span<CellWeight> found{cells_.data(), next};
    const double scale = 1 / (sum * grid_.cell_volume());
    for (CellWeight& cell : found) cell.weight *= scale;
    return found;
}

std::span<const CellWeight> Footprint::of_point(const Vec3& point, double radius) {
    const double stretch = stretch_of(radius);
    set_box(point, point, stretch, stretch);
    return listed([&](const auto& add) { each_near(point, stretch, add); });
}

// How many stretches a line is divided into.
int Footprint::stretches_of(const Vec3& branch, double stretch) const {
    const double longest = longest_stretch * stretch * kernel_.width();
    return std::max(1, static_cast<int>(std::ceil(branch.norm() / longest)));
}

std::span<const CellWeight> Footprint::of_line(const Vec3& begin, const Vec3& branch, double radius) {
    const double stretch = stretch_of(radius);
    set_box(begin, begin + branch, stretch, stretch);
    const std::size_t width = offsets_[along_].size(), rows = offsets_[across_].size();
    values_.assign(width * rows * offsets_[2].size(), 0);
    const int stretches = stretches_of(branch, stretch);
    for (int n = 0; n < stretches; ++n)
        for (const auto& [at, share] : quadrature)
            each_near(begin + (n + at) / stretches * branch, stretch,
                      [&, share = share](std::size_t z, std::size_t other, std::size_t first,
                                         std::size_t last, const auto& value) {
                          double* const row = values_.data() + (z * rows + other) * width;
                          for (std::size_t k = first; k < last; ++k) row[k] += share * value(k);
                      });
    return listed([&](const auto& add) {
        for (std::size_t z = 0; z < offsets_[2].size(); ++z)
            for (std::size_t other = 0; other < rows; ++other) {
                const double* const row = values_.data() + (z * rows + other) * width;
                add(z, other, 0, width, [row](std::size_t k) { return row[k]; });
            }
    });
}

// The kernel at the end of the line is the one at the beginning, stretched about its middle. So each part of
// it goes from begin + x to begin + branch + x w_1 / w_0 in a straight line. By the continuity equation W_s
// flows with the velocity branch + x d(ln w_s)/ds, where x is the place relative to the middle.
std::span<const CellWay> Footprint::of_changing_line(const Vec3& begin, const Vec3& branch, double radius,
                                                     double other_radius) {
    const double stretch = stretch_of(radius), growth = stretch_of(other_radius) - stretch;
    set_box(begin, begin + branch, stretch, stretch + growth);
    const std::size_t width = offsets_[along_].size(), rows = offsets_[across_].size();
    flows_.assign(4 * width * rows * offsets_[2].size(), 0);
    const int stretches = stretches_of(branch, std::min(stretch, stretch + growth));
    for (int n = 0; n < stretches; ++n)
        for (const auto& [at, share] : quadrature) {
            const double s = (n + at) / stretches, here = stretch + s * growth, drift = growth / here;
            const Vec3 middle = begin + s * branch;
            const double part = share * math::pow(here, -grid_.dimensions());
            // The drift of a cell along an axis.
            const auto drift_at = [&](std::size_t axis, std::size_t k) {
                const GridAxis& of = grid_.axes[axis];
                const auto cell = box_[axis].begin + static_cast<std::int64_t>(k);
                return of.resolved ? drift * (of.middle(cell) - middle[static_cast<int>(axis)]) : 0.0;
            };
            each_near(middle, here,
                      [&](std::size_t z, std::size_t other, std::size_t first, std::size_t last,
                          const auto& value) {
                          Eigen::Array4d flow;
                          flow << 0, 0, drift_at(2, z), 1;
                          flow[static_cast<int>(across_)] = drift_at(across_, other);
                          const double step = drift * grid_.axes[along_].cell;
                          double along = first < last ? drift_at(along_, first) : 0;
                          double* const row = flows_.data() + 4 * (z * rows + other) * width;
                          for (std::size_t k = first; k < last; ++k, along += step) {
                              flow[static_cast<int>(along_)] = along;
                              Eigen::Map<Eigen::Array4d>(row + 4 * k) += part * value(k) * flow;
                          }
                      });
        }
    return listed_ways(branch);
}

// Lists the ways, scaled so that the sum of the weights times volume is 1 and the sum of the drifts is 0, as
// it would be in infinitely small cells.
std::span<const CellWay> Footprint::listed_ways(const Vec3& branch) {
    const std::size_t cells = flows_.size() / 4;
    Eigen::Array4d sum = Eigen::Array4d::Zero();
    for (std::size_t c = 0; c < cells; ++c) sum += Eigen::Map<const Eigen::Array4d>(&flows_[4 * c]);
    const double scale = 1 / (grid_.cell_volume() * sum[3]);
    const Vec3 mean = branch - sum.head<3>().matrix() / sum[3];
    ways_.resize(std::max(ways_.size(), cells));
    CellWay* next = ways_.data();
    const double* flow = flows_.data();
    for (const std::int64_t z : offsets_[2])
        for (const std::int64_t other : offsets_[across_])
            for (const std::int64_t along : offsets_[along_]) {
                if (flow[3] > 0 && (z | other | along) >= 0)
                    *next++ = {z + other + along, scale * (flow[3] * mean + Eigen::Map<const Vec3>(flow))};
                flow += 4;
            }
    return {ways_.data(), next};
}

}  // namespace grainreel
