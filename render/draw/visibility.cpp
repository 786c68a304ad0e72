#include "render/draw/visibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainreel {
namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();

// Where a sphere's silhouette begins and ends along one picture axis, as x/z: the tangents from the eye,
// (c - s z)^2 = r^2 (1 + s^2) (after Mara & McGuire 2013). Needs z > r.
struct Span {
    double low, high;
};
Span tangents(double c, double z, double r) {
    const double root = r * std::sqrt(std::max(0.0, c * c + z * z - r * r)), below = z * z - r * r;
    return {(c * z - root) / below, (c * z + root) / below};
}

// The row loops below are kept free of branches so that the compiler turns them into vector code. The
// discriminant comes from the point of closest approach, which keeps its digits when a sphere is small
// against its distance (Haines et al. 2019).
struct Row {
    const float* slope_x;
    float* depth;
    std::uint32_t* seen;
    int count;
};

void perspective_row(const Row& row, const ViewSphere& sphere, float slope_y, std::uint32_t number) {
    const auto [x, y, z, r] = sphere;
    const float dot_rest = y * slope_y + z, square_rest = slope_y * slope_y + 1, r_square = r * r;
    const float* const __restrict slope_x = row.slope_x;
    float* const __restrict depth = row.depth;
    std::uint32_t* const __restrict seen = row.seen;
    for (int i = 0; i < row.count; ++i) {
        const float slope = slope_x[i];
        const float inverse = 1 / (slope * slope + square_rest);
        const float along = (x * slope + dot_rest) * inverse;
        const float miss_x = x - along * slope, miss_y = y - along * slope_y, miss_z = z - along;
        const float rest = r_square - (miss_x * miss_x + miss_y * miss_y + miss_z * miss_z);
        const float half_chord = std::sqrt((rest > 0 ? rest : 0) * inverse);
        const float entry = along - half_chord;
        const float away = entry > 0 ? entry : along + half_chord;  // from within, the far side
        const bool closer = (rest >= 0) & (away > 0) & (away < depth[i]);
        depth[i] = closer ? away : depth[i];
        seen[i] = closer ? number : seen[i];
    }
}

void orthographic_row(const Row& row, const ViewSphere& sphere, float slope_y, std::uint32_t number) {
    const auto [x, y, z, r] = sphere;
    const float rest_y = r * r - (y - slope_y) * (y - slope_y);
    const float* const __restrict slope_x = row.slope_x;
    float* const __restrict depth = row.depth;
    std::uint32_t* const __restrict seen = row.seen;
    for (int i = 0; i < row.count; ++i) {
        const float miss = x - slope_x[i];
        const float rest = rest_y - miss * miss;
        const float away = z - std::sqrt(rest > 0 ? rest : 0);
        const bool closer = (rest >= 0) & (away < depth[i]);
        depth[i] = closer ? away : depth[i];
        seen[i] = closer ? number : seen[i];
    }
}

}  // namespace

void PixelBox::include(const PixelBox& other) {
    if (other.empty()) return;
    if (empty()) {
        *this = other;
        return;
    }
    x0 = std::min(x0, other.x0);
    y0 = std::min(y0, other.y0);
    x1 = std::max(x1, other.x1);
    y1 = std::max(y1, other.y1);
}

Visibility::Visibility(int width, int height)
    : width_(width),
      height_(height),
      depth_(static_cast<std::size_t>(width) * height, nothing),
      seen_(depth_.size(), 0),
      marked_row_(2 * static_cast<std::size_t>(width)),
      slope_x_(static_cast<std::size_t>(width)) {}

PixelBox Visibility::bounds(const View& view, const ViewSphere& sphere) const {
    const double x = sphere[0], y = sphere[1], z = sphere[2], r = sphere[3];
    if (!view.orthographic && z <= -r) return {};
    if (!view.orthographic && z <= r * 1.0001) return {0, 0, width_, height_};  // around the eye's plane
    const Span across = view.orthographic ? Span{x - r, x + r} : tangents(x, z, r);
    const Span upward = view.orthographic ? Span{y - r, y + r} : tangents(y, z, r);
    const auto pixel = [&](double slope, int size) {
        return static_cast<int>(std::clamp(0.5 * size + view.focal * slope, 0.0, static_cast<double>(size)));
    };
    return {pixel(across.low, width_), pixel(upward.low, height_),
            std::min(width_, pixel(across.high, width_) + 1),
            std::min(height_, pixel(upward.high, height_) + 1)};
}

void Visibility::draw(const View& view, const ViewSphere& sphere, const PixelBox& box, std::uint32_t number) {
    for (int y = box.y0; y < box.y1; ++y) {
        const auto slope_y = static_cast<float>((y + 0.5 - 0.5 * height_) / view.focal);
        const std::size_t first = static_cast<std::size_t>(y) * width_ + box.x0;
        const Row row{slope_x_.data() + box.x0, depth_.data() + first, seen_.data() + first, box.x1 - box.x0};
        if (view.orthographic)
            orthographic_row(row, sphere, slope_y, number);
        else
            perspective_row(row, sphere, slope_y, number);
    }
}

void Visibility::update(const View& view, const std::vector<ViewSphere>& spheres) {
    for (int y = covered_.y0; y < covered_.y1; ++y) {
        const std::size_t row = static_cast<std::size_t>(y) * width_;
        std::fill(depth_.begin() + row + covered_.x0, depth_.begin() + row + covered_.x1, nothing);
        std::fill(seen_.begin() + row + covered_.x0, seen_.begin() + row + covered_.x1, 0u);
    }
    for (int x = 0; x < width_; ++x)
        slope_x_[static_cast<std::size_t>(x)] = static_cast<float>((x + 0.5 - 0.5 * width_) / view.focal);
    changed_ = covered_;
    covered_ = {};
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const PixelBox box = bounds(view, spheres[i]);
        if (box.empty()) continue;
        draw(view, spheres[i], box, static_cast<std::uint32_t>(i + 1));
        covered_.include(box);
    }
    if (covered_.empty()) return;
    // One pixel more all around: there the smooth edges end.
    covered_ = {std::max(0, covered_.x0 - 1), std::max(0, covered_.y0 - 1), std::min(width_, covered_.x1 + 1),
                std::min(height_, covered_.y1 + 1)};
    changed_.include(covered_);
    mark_edges();
}

// In place, so the unmarked numbers of the row below are kept aside.
void Visibility::mark_edges() {
    const auto width = static_cast<std::size_t>(width_);
    std::uint32_t* below = marked_row_.data();
    std::uint32_t* own = below + width;
    std::copy_n(seen_.data() + covered_.y0 * width, width, below);
    for (int y = covered_.y0; y < covered_.y1; ++y) {
        std::uint32_t* row = seen_.data() + y * width;
        const std::uint32_t* above = y + 1 < height_ ? row + width : own;
        std::copy_n(row, width, own);
        const int first = std::max(1, covered_.x0), last = std::min(width_ - 1, covered_.x1);
        for (int x = first; x < last; ++x) {
            const std::uint32_t here = own[x];
            const std::uint32_t other =
                (own[x - 1] ^ here) | (own[x + 1] ^ here) | (below[x] ^ here) | (above[x] ^ here);
            row[x] = other ? here | edge : here;
        }
        std::swap(below, own);
    }
}

}  // namespace grainreel
