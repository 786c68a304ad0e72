#include "render/picture/container/ground.hpp"

#include <algorithm>
#include <cmath>

#include "render/picture/container/shade_row.hpp"
#include "render/picture/spheres/light/lamp.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr int kSide = ShadowMap::kSide;

float rim(int cell) {
    const int inside = std::min(2 * cell + 1, 2 * (kSide - cell) - 1);  // half cells
    const float t = std::min(5 * static_cast<float>(inside) / kSide, 1.0f);
    return t * t * (3 - 2 * t);
}

// A twelfth of the height from the rim on all is seen, so that no line shows where the picture ends.
float margin(int pixel, int size, int height) {
    const float inside = std::min(static_cast<float>(pixel) + 0.5f, static_cast<float>(size - pixel) - 0.5f);
    return std::min(12 * inside / static_cast<float>(height), 1.0f);
}

}  // namespace

Ground::Ground(const FilmedScene& scene, const Rectangle& port)
    : map_(scene),
      strength_(scene.film.look.style == FilmLook::Style::dark ? 0.75f : 0.30f),
      width_(port.width),
      height_(port.height),
      dark_(kStride * kStride) {
    for (int cell = 0; cell < kSide; ++cell) rim_.push_back(rim(cell));
    for (int x = 0; x < width_; ++x) across_.push_back(margin(x, width_, height_));
}

void Ground::update(const Frame& frame, const View& view) {
    const Lamp lamp;
    view_ = view;
    map_.cast(frame, lamp.to_key[0] * view.right + lamp.to_key[1] * view.up + lamp.to_key[2] * view.forward);
    darken();
    part_ = where();
}

void Ground::darken() {
    constexpr float kSeen = 0.5f;  // of a level
    int left = kSide, right = 0, low = kSide, high = 0;
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
            const float dark = 255 * strength_ * rim_[static_cast<std::size_t>(i)] *
                               rim_[static_cast<std::size_t>(j)] *
                               map_.cells()[static_cast<std::size_t>(j * kSide + i)];
            dark_[static_cast<std::size_t>((j + 1) * kStride + i + 1)] = dark;
            if (dark < kSeen) continue;
            left = std::min(left, i), right = std::max(right, i + 1);
            low = std::min(low, j), high = std::max(high, j + 1);
        }
    dark_cells_ = {left, low, std::max(0, right - left), std::max(0, high - low)};
}

Vec3 Ground::on_ground(double u, double v) const {
    return {map_.low().x() + u * map_.side(), map_.low().y() + v * map_.side(), map_.height()};
}

// From below there is no ground, nor where a corner of the map lies behind the eye.
bool Ground::is_seen() const {
    if (view_.eye.z() < map_.height()) return false;
    for (int corner = 0; corner < 4 && !view_.orthographic; ++corner)
        if (view_.to_view(on_ground(corner & 1, corner >> 1)).z() <= 0) return false;
    return true;
}

Rectangle Ground::where() const {
    if (dark_cells_.width == 0 || !is_seen()) return {};
    constexpr int kMargin = 1;  // cells, as far as the filter reaches
    constexpr double side = kSide;
    const auto ends = [](int first, int count) {
        return std::array{std::max(0, first - kMargin), std::min(kSide, first + count + kMargin)};
    };
    Eigen::Array2d low(width_, height_), high(0, 0);
    for (const int i : ends(dark_cells_.x, dark_cells_.width))
        for (const int j : ends(dark_cells_.y, dark_cells_.height)) {
            const Eigen::Array2d pixel = view_.project(on_ground(i / side, j / side));
            low = low.min(pixel);
            high = high.max(pixel);
        }
    const Eigen::Array2i from = low.max(0).floor().cast<int>(),
                         to = high.min(Eigen::Array2d(width_, height_)).ceil().cast<int>();
    return {from.x(), from.y(), std::max(0, to.x() - from.x()), std::max(0, to.y() - from.y())};
}

// What a pixel's line of sight meets of the ground: (u, v, w), linear in x and y, of the cell u/w, v/w.
Vec3 Ground::seen_at(double x, double y) const {
    const Vec3 beside = ((x - 0.5 * width_) * view_.right + (0.5 * height_ - y) * view_.up) / view_.focal;
    const Vec3 from = view_.orthographic ? Vec3(view_.eye + beside) : view_.eye;
    const Vec3 along = view_.orthographic ? view_.forward : Vec3(view_.forward + beside);
    const Eigen::Vector2d at =
        (from.head<2>() - map_.low()) * along.z() + (map_.height() - from.z()) * along.head<2>();
    return {at.x() * kSide / map_.side(), at.y() * kSide / map_.side(), along.z()};
}

void Ground::shade(int y, std::uint32_t* pixels) const {
    if (y < part_.y || y >= part_.y + part_.height) return;
    const Vec3 first = seen_at(part_.x + 0.5, y + 0.5), step = seen_at(part_.x + 1.5, y + 0.5) - first;
    // The middle of the first cell lies half a cell from the map's corner, and one from that of `dark_`.
    const Vec3 shifted = first + 0.5 * first.z() * Vec3(1, 1, 0),
               shifted_step = step + 0.5 * step.z() * Vec3(1, 1, 0);
    shade_row({dark_.data(), kStride}, {shifted.cast<float>(), shifted_step.cast<float>()},
              across_.data() + part_.x, margin(y, height_, height_), pixels + part_.x, part_.width);
}

}  // namespace grainreel
