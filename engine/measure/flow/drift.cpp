#include "engine/measure/flow/drift.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/measure/measures.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {

namespace {

constexpr double kCell = 2;  // diameters
constexpr double kMostCells = 255;

// Makes cells about two mean diameters wide and high. Their number across is odd, so that one is in the
// middle.
VelocityGrid cells_of(const Scene& scene) {
    VelocityGrid grid;
    const Container& c = scene.container;
    if (c.shape == Container::Shape::none) return grid;
    const double cell = kCell * mean_diameter(scene);
    const double half = std::clamp(std::round((2 * c.half_width / cell - 1) / 2), 1.0, (kMostCells - 1) / 2);
    grid.across = static_cast<std::size_t>(2 * half + 1);
    grid.high =
        static_cast<std::size_t>(std::clamp(std::ceil((c.height - c.base()) / cell), 2.0, kMostCells));
    grid.left = -c.half_width;
    grid.bottom = c.base();
    grid.width = 2 * c.half_width / static_cast<double>(grid.across);
    grid.height = (c.height - c.base()) / static_cast<double>(grid.high);
    const std::size_t cells = grid.across * grid.high;
    grid.right.assign(cells, 0), grid.up.assign(cells, 0), grid.weight.assign(cells, 0);
    return grid;
}

// Cell of a place. Places outside belong to the outermost cells.
std::size_t cell_at(const VelocityGrid& grid, double y, double z) {
    const auto number = [](double at, std::size_t count) {
        return static_cast<std::size_t>(std::clamp(std::floor(at), 0.0, static_cast<double>(count - 1)));
    };
    return grid.index(number((y - grid.left) / grid.width, grid.across),
                      number((z - grid.bottom) / grid.height, grid.high));
}

void add(VelocityGrid& sums, std::size_t cell, double right, double up, double weight) {
    sums.right[cell] += weight * right;
    sums.up[cell] += weight * up;
    sums.weight[cell] += weight;
}

// Turns sums into means.
void divide(VelocityGrid& grid) {
    for (std::size_t i = 0; i < grid.weight.size(); ++i) {
        if (grid.weight[i] == 0) continue;
        grid.right[i] /= grid.weight[i];
        grid.up[i] /= grid.weight[i];
    }
}

bool holds_grains(const VelocityGrid& grid) {
    return std::any_of(grid.weight.begin(), grid.weight.end(), [](double weight) { return weight > 0; });
}

struct Mean {
    double sum = 0, count = 0;
    void add(double value) { sum += value, count += 1; }
    double value() const { return sum / count; }
};

}  // namespace

Drift::Drift(const Scene& scene)
    : walls_(scene), half_width_(scene.container.half_width), cells_(cells_of(scene)) {}

void Drift::note(std::int64_t period, const Grains& grains, const DrivePose& pose) {
    if (cells_.weight.empty()) return;
    if (period != next_) windows_.clear();
    if (period == next_) {
        Window window = compare(grains, pose);
        // A window without grains is dropped, because a feed may come later.
        if (holds_grains(window.grid)) windows_.push_back(std::move(window));
    }
    if (windows_.size() > kWindows) windows_.pop_front();
    find_centres();
    remember(grains, pose);
    next_ = period + kPeriods;
}

void Drift::remember(const Grains& grains, const DrivePose& pose) {
    before_.assign(before_.size(), {kUnknown, kUnknown});
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const auto id = static_cast<std::size_t>(grains.id[i]);
        if (id >= before_.size()) before_.resize(id + 1, {kUnknown, kUnknown});
        const Vec3 place = grains.place[i].position - pose.offset;
        before_[id] = {place.y(), place.z()};
    }
}

Drift::Window Drift::compare(const Grains& grains, const DrivePose& pose) const {
    Window window;
    window.grid = cells_;
    Mean all;
    std::array<Mean, zones> zone;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const auto id = static_cast<std::size_t>(grains.id[i]);
        if (id >= before_.size() || std::isnan(before_[id][0])) continue;
        const Vec3 place = grains.place[i].position - pose.offset;
        const double right = (place.y() - before_[id][0]) / kPeriods,
                     up = (place.z() - before_[id][1]) / kPeriods;
        const double y = 0.5 * (place.y() + before_[id][0]), z = 0.5 * (place.z() + before_[id][1]);
        add(window.grid, cell_at(cells_, y, z), right, up, 1);
        all.add(up);
        const Side side = walls_.side_of(
            {{grains.place[i].position.x() - pose.offset.x(), y, z}, grains.place[i].radius}, DrivePose());
        if (side == Side::left) zone[at_left_wall].add(up);
        if (side == Side::right) zone[at_right_wall].add(up);
        if (std::abs(y) < half_width_ / 3) zone[in_middle].add(up);
    }
    divide(window.grid);
    for (std::size_t z = 0; z < zones; ++z) window.rise[z] = zone[z].value() - all.value();
    window.left_roll = circulation(window.grid, -half_width_, 0).speed();
    window.right_roll = -circulation(window.grid, 0, half_width_).speed();
    return window;
}

template <class Value>
Estimate Drift::estimate(const Value& value) const {
    const auto count = static_cast<double>(windows_.size());
    double mean = 0, squares = 0;
    for (const Window& window : windows_) mean += value(window) / count;
    for (const Window& window : windows_) squares += (value(window) - mean) * (value(window) - mean);
    if (windows_.empty()) return {kUnknown, kUnknown};
    return {mean, windows_.size() > 1 ? std::sqrt(squares / (count - 1) / count) : kUnknown};
}

Estimate Drift::rise(Zone zone) const {
    return estimate([&](const Window& window) { return window.rise[zone]; });
}

Estimate Drift::roll(Side half) const {
    return estimate(
        [&](const Window& window) { return half == Side::left ? window.left_roll : window.right_roll; });
}

VelocityGrid Drift::sum_of_windows() const {
    VelocityGrid sum = cells_;
    for (const Window& window : windows_)
        for (std::size_t i = 0; i < sum.weight.size(); ++i)
            add(sum, i, window.grid.right[i], window.grid.up[i], window.grid.weight[i]);
    divide(sum);
    return sum;
}

void Drift::find_centres() {
    left_centre_ = right_centre_ = {};
    if (windows_.empty()) return;
    const VelocityGrid grid = sum_of_windows();
    const std::vector<double> psi = stream_function(grid);
    left_centre_ = roll_centre(grid, psi, -half_width_, 0);
    right_centre_ = roll_centre(grid, psi, 0, half_width_);
}

void Drift::save(std::ostream& out) const {
    const Writing each{out};
    each(next_), each(before_), each(static_cast<std::uint64_t>(windows_.size()));
    for (const Window& w : windows_)
        each(w.rise), each(w.left_roll), each(w.right_roll), each(w.grid.right), each(w.grid.up),
            each(w.grid.weight);
}

void Drift::load(Bytes& in) {
    const Reading each{in};
    std::uint64_t count = 0;
    each(next_), each(before_), each(count);
    if (count > kWindows) in.fail();
    for (std::uint64_t i = 0; i < count && !in.failed(); ++i) {
        Window& w = windows_.emplace_back();
        w.grid = cells_;
        each(w.rise), each(w.left_roll), each(w.right_roll), each(w.grid.right), each(w.grid.up),
            each(w.grid.weight);
        const std::size_t cells = cells_.weight.size();
        if (w.grid.right.size() != cells || w.grid.up.size() != cells || w.grid.weight.size() != cells)
            in.fail();
    }
    if (!in.failed()) find_centres();
}

namespace {

// The integral of u . dl around the square whose corners are the middles of cell (j, k) and its neighbours to
// the right and above.
double around_square(const VelocityGrid& g, std::size_t j, std::size_t k) {
    const std::size_t a = g.index(j, k), b = g.index(j + 1, k), c = g.index(j + 1, k + 1),
                      d = g.index(j, k + 1);
    return 0.5 * g.width * (g.right[a] + g.right[b] - g.right[c] - g.right[d]) +
           0.5 * g.height * (g.up[b] + g.up[c] - g.up[d] - g.up[a]);
}

// The squares that lie between four filled cells, in a range of y.
class Squares {
  public:
    Squares(const VelocityGrid& grid, double from, double to) : grid_(grid), from_(from), to_(to) {}

    // Whether there is such a square. There is none outside the grid.
    bool there(std::size_t j, std::size_t k) const {
        if (j >= grid_.across - 1 || k >= grid_.high - 1) return false;
        const double slack = 1e-9 * grid_.width;
        if (grid_.y(j) < from_ - slack || grid_.y(j + 1) > to_ + slack) return false;
        return grid_.weight[grid_.index(j, k)] > 0 && grid_.weight[grid_.index(j + 1, k)] > 0 &&
               grid_.weight[grid_.index(j, k + 1)] > 0 && grid_.weight[grid_.index(j + 1, k + 1)] > 0;
    }
    // Length (m) of the sides of a square that no other square shares. For j = 0, j - 1 is a large number,
    // and so outside.
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
