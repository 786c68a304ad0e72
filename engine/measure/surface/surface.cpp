#include "engine/measure/surface/surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/numbers.hpp"
#include "engine/measure/surface/spectrum.hpp"

namespace grainreel {
namespace {

constexpr double kColumn = 2;  // diameters, width and depth
constexpr double kGap = 1.5;   // diameters between grains that stand on each other, at most
constexpr double kEmpty = -std::numeric_limits<double>::infinity();
constexpr int kMostColumns = 512;  // along one edge

// What a grain takes up of the vertical through a column. m
struct Chord {
    double low, high;
};

int columns_in(double length, double diameter) {
    return std::clamp(static_cast<int>(std::round(length / (kColumn * diameter))), 1, kMostColumns);
}

class Columns {
  public:
    explicit Columns(const SurfaceFrame& frame)
        : frame_(frame),
          across_(columns_in(frame.right - frame.left, frame.diameter)),
          deep_(columns_in(frame.front - frame.back, frame.diameter)),
          width_((frame.right - frame.left) / across_),
          depth_((frame.front - frame.back) / deep_),
          chords_(static_cast<std::size_t>(across_ * deep_)),
          covered_(chords_.size(), false) {}

    void add(const Place& grain) {
        const Vec3& p = grain.position;
        const double y = (p.y() - frame_.left) / width_;
        const double x = (nearest_image(p.x(), frame_.period) - frame_.back) / depth_;
        const int own_y = std::clamp(static_cast<int>(std::floor(y)), 0, across_ - 1);
        const int own_x = std::clamp(static_cast<int>(std::floor(x)), 0, deep_ - 1);
        at(own_y, own_x).push_back({p.z() - grain.radius, p.z() + grain.radius});
        covered_[index(own_y, own_x)] = true;
        const int reach_y = static_cast<int>(grain.radius / width_ + 1);
        const int reach_x = static_cast<int>(grain.radius / depth_ + 1);
        for (int j = std::max(0, own_y - reach_y); j <= std::min(across_ - 1, own_y + reach_y); ++j) {
            for (int i = std::max(0, own_x - reach_x); i <= std::min(deep_ - 1, own_x + reach_x); ++i) {
                if (j == own_y && i == own_x) continue;
                const double dy = std::max(0.0, std::abs(j + 0.5 - y) - 0.5) * width_;
                const double dx = std::max(0.0, std::abs(i + 0.5 - x) - 0.5) * depth_;
                const double square = grain.radius * grain.radius - dy * dy - dx * dx;
                if (square > 0) at(j, i).push_back({p.z() - std::sqrt(square), p.z() + std::sqrt(square)});
                const double to_middle = std::hypot((j + 0.5 - y) * width_, (i + 0.5 - x) * depth_);
                if (to_middle < grain.radius) covered_[index(j, i)] = true;
            }
        }
    }

    BedOutline surface() {
        BedOutline s{frame_.left, width_, std::vector<double>(static_cast<std::size_t>(across_), kEmpty)};
        for (int j = 0; j < across_; ++j) {
            double sum = 0, filled = 0;
            for (int i = 0; i < deep_; ++i) {
                if (!covered_[index(j, i)]) continue;
                sum += top_of(at(j, i));
                filled += 1;
            }
            if (filled > 0) s.height[static_cast<std::size_t>(j)] = sum / filled;
        }
        return s;
    }

  private:
    std::size_t index(int j, int i) const { return static_cast<std::size_t>(j * deep_ + i); }
    std::vector<Chord>& at(int j, int i) { return chords_[index(j, i)]; }

    double top_of(std::vector<Chord>& chords) const {
        std::sort(chords.begin(), chords.end(), [](const Chord& a, const Chord& b) { return a.low < b.low; });
        double top = kEmpty;
        for (const Chord& chord : chords) {
            if (top != kEmpty && chord.low > top + kGap * frame_.diameter) break;
            top = std::max(top, chord.high);
        }
        return top;
    }

    const SurfaceFrame frame_;
    const int across_, deep_;
    const double width_, depth_;  // m, of a column
    std::vector<std::vector<Chord>> chords_;
    std::vector<bool> covered_;  // by a grain whose centre is in the column, or that reaches over its middle
};

// The mean of the nearest filled bins on both sides, or that of one side.
void fill_gaps(std::vector<double>& height) {
    const std::vector<double> given = height;
    const auto count = static_cast<std::ptrdiff_t>(given.size());
    const auto nearest = [&](std::ptrdiff_t from, std::ptrdiff_t step) {
        while (from >= 0 && from < count && given[static_cast<std::size_t>(from)] == kEmpty) from += step;
        return from >= 0 && from < count ? given[static_cast<std::size_t>(from)] : kEmpty;
    };
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        if (given[static_cast<std::size_t>(i)] != kEmpty) continue;
        const double left = nearest(i, -1), right = nearest(i, 1);
        height[static_cast<std::size_t>(i)] = left == kEmpty    ? right
                                              : right == kEmpty ? left
                                                                : 0.5 * (left + right);
    }
}

}  // namespace

double BedOutline::mean() const {
    return mean_height_of(height);
}

std::size_t bins_across(const SurfaceFrame& frame) {
    return static_cast<std::size_t>(columns_in(frame.right - frame.left, frame.diameter));
}

BedOutline surface_of(std::span<const Place> grains, const SurfaceFrame& frame) {
    if (grains.empty()) return {};
    Columns columns(frame);
    for (const Place& grain : grains) columns.add(grain);
    BedOutline surface = columns.surface();
    fill_gaps(surface.height);
    return surface;
}

}  // namespace grainreel
