#include "engine/measure/surface/surface.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/measure/measures.hpp"
#include "engine/measure/walls/wall_bodies.hpp"
#include "engine/mesh/room.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/scene/bed.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

constexpr double kColumn = 2;  // diameters, width and depth
constexpr double kGap = 1.5;   // diameters, the largest gap between grains that stand on each other
constexpr double kEmpty = -std::numeric_limits<double>::infinity();
constexpr int kMostColumns = 512;  // along one edge

// The part (m) of the vertical through a column that a grain takes up.
struct Chord {
    double low, high;
};

int columns_in(double length, double diameter) {
    return std::clamp(static_cast<int>(std::round(length / (kColumn * diameter))), 1, kMostColumns);
}

class Columns {
  public:
    explicit Columns(const SurfaceAxes& frame)
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
                const double to_middle = math::hypot((j + 0.5 - y) * width_, (i + 0.5 - x) * depth_);
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
            if (filled > 0) s.height[j] = sum / filled;
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

    const SurfaceAxes frame_;
    const int across_, deep_;
    const double width_, depth_;  // m, of a column
    std::vector<std::vector<Chord>> chords_;
    std::vector<bool>
        covered_;  // columns with a grain whose centre is in the column or that reaches over its middle
};

// Fills empty bins with the mean of the nearest filled bins on both sides, or with the bin on one side.
void fill_gaps(std::vector<double>& height) {
    const std::vector<double> given = height;
    const auto count = static_cast<std::ptrdiff_t>(given.size());
    const auto nearest = [&](std::ptrdiff_t from, std::ptrdiff_t step) {
        while (from >= 0 && from < count && given[from] == kEmpty) from += step;
        return from >= 0 && from < count ? given[from] : kEmpty;
    };
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        if (given[i] != kEmpty) continue;
        const double left = nearest(i, -1), right = nearest(i, 1);
        height[i] = left == kEmpty ? right : right == kEmpty ? left : 0.5 * (left + right);
    }
}

}  // namespace

double BedOutline::mean() const {
    return mean_height_of(height);
}

std::size_t bins_across(const SurfaceAxes& frame) {
    return static_cast<std::size_t>(columns_in(frame.right - frame.left, frame.diameter));
}

BedOutline surface_of(std::span<const Place> grains, const SurfaceAxes& frame) {
    if (grains.empty()) return {};
    Columns columns(frame);
    for (const Place& grain : grains) columns.add(grain);
    BedOutline surface = columns.surface();
    fill_gaps(surface.height);
    return surface;
}

namespace {

constexpr double kSettled = 0.6;  // solid fraction of a bed at rest

}  // namespace

SurfaceAxes surface_frame(const Scene& scene) {
    SurfaceAxes frame;
    const Container& c = scene.container;
    if (c.shape == Container::Shape::none || turns_over(scene)) return frame;
    frame.diameter = mean_diameter(scene);
    const double filled = fill_height(scene, kSettled);
    frame.right = c.half_width_at(filled);
    frame.left = -frame.right;
    frame.front = c.shape == Container::Shape::cylinder ? c.half_width
                  : c.shape == Container::Shape::mesh   ? c.room->half_depth_at(filled)
                                                        : 0.5 * c.depth;
    frame.back = -frame.front;
    frame.period = period_of_depth(c);
    return frame;
}

namespace {

constexpr std::size_t kLeastBins = 6;

// Slope over the bins from `first` to the one before `end`.
double slope_of(const BedOutline& s, std::size_t first, std::size_t end) {
    const auto count = static_cast<double>(end - first);
    double places = 0, heights = 0;
    for (std::size_t i = first; i < end; ++i) {
        places += s.place(i) / count;
        heights += s.height[i] / count;
    }
    double together = 0, squares = 0;
    for (std::size_t i = first; i < end; ++i) {
        together += (s.place(i) - places) * (s.height[i] - heights);
        squares += (s.place(i) - places) * (s.place(i) - places);
    }
    return together / squares;
}

// Mean height between two places; a bin counts by the part of it that lies between them.
double mean_between(const BedOutline& s, double from, double to) {
    double sum = 0, width = 0;
    for (std::size_t i = 0; i < s.height.size(); ++i) {
        const double low = std::max(from, s.place(i) - 0.5 * s.bin),
                     high = std::min(to, s.place(i) + 0.5 * s.bin);
        if (high <= low) continue;
        sum += (high - low) * s.height[i];
        width += high - low;
    }
    return sum / width;
}

}  // namespace

Mound mound_of(const BedOutline& s) {
    const std::size_t count = s.height.size();
    if (count < kLeastBins) return {kUnknown, kUnknown, kUnknown};
    const double sixth = s.width() / 6, right = s.left + s.width();
    const double middle = mean_between(s, s.left + 2 * sixth, right - 2 * sixth);
    const double edges =
        0.5 * (mean_between(s, s.left, s.left + sixth) + mean_between(s, right - sixth, right));
    const std::size_t half = count / 2;  // with an odd number of bins, the middle bin belongs to neither half
    return {middle - edges, 0.5 * (slope_of(s, 0, half) - slope_of(s, count - half, count)),
            slope_of(s, 0, count)};
}

Spectrum::Spectrum(std::size_t bins) : bins_(bins) {
    for (std::size_t n = 0; n < 2 * bins; ++n) {
        const auto [sine, cosine] =
            math::sin_cos(std::numbers::pi * static_cast<double>(n) / static_cast<double>(bins));
        sines_.push_back(sine), cosines_.push_back(cosine);
    }
}

// The shift by half a bin changes no |H_k|, so the sums leave it out.
DominantWave Spectrum::dominant(const std::vector<double>& heights, double width) const {
    GRAINREEL_CHECK(heights.size() == bins_);
    const double mean = mean_height_of(heights), variance = variance_of(heights);
    std::size_t dominant = 0;
    double largest = 0;
    for (std::size_t k = 1; k <= bins_ / 2; ++k) {
        double by_cosine = 0, by_sine = 0;
        for (std::size_t j = 0, n = 0; j < bins_; ++j, n = (n + k) % (2 * bins_)) {
            const double height = heights[j] - mean;
            by_cosine += height * cosines_[n], by_sine += height * sines_[n];
        }
        const double power = by_cosine * by_cosine + by_sine * by_sine;
        if (power > largest) largest = power, dominant = k;
    }
    if (dominant == 0 || variance == 0) return {kUnknown, kUnknown};
    const auto count = static_cast<double>(bins_);
    return {2 * width / static_cast<double>(dominant), 2 * largest / (count * count * variance)};
}

double mean_height_of(const std::vector<double>& heights) {
    return std::accumulate(heights.begin(), heights.end(), 0.0) / static_cast<double>(heights.size());
}

double variance_of(const std::vector<double>& heights) {
    const double mean = mean_height_of(heights);
    double sum = 0;
    for (const double h : heights) sum += (h - mean) * (h - mean);
    return sum / static_cast<double>(heights.size());
}

Subharmonics subharmonics_of(const std::vector<const std::vector<double>*>& surfaces) {
    GRAINREEL_CHECK(surfaces.size() == kComparedPeriods);
    const std::size_t bins = surfaces.front()->size();
    std::vector<double> mean;
    for (const std::vector<double>* const h : surfaces) {
        GRAINREEL_CHECK(h->size() == bins);
        mean.push_back(mean_height_of(*h));
    }
    double power = 0, half = 0, quarter = 0;
    for (std::size_t j = 0; j < bins; ++j) {
        std::complex<double> a = 0, b = 0, turn = 1;  // turn = (-i)^n
        for (std::size_t n = 0; n < kComparedPeriods; ++n) {
            const double h = (*surfaces[n])[j] - mean[n];
            power += h * h / kComparedPeriods;
            a += turn * turn * h / static_cast<double>(kComparedPeriods);
            b += turn * h / static_cast<double>(kComparedPeriods);
            turn *= std::complex<double>(0, -1);
        }
        half += std::norm(a);
        quarter += 2 * std::norm(b);
    }
    if (power == 0) return {kUnknown, kUnknown};
    return {half / power, quarter / power};
}

}  // namespace grainreel
