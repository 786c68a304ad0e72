// Paints the rows of the ground and of the backdrop, and darkens them by the map of the ground's shadow.
#include "render/picture/container/ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/scene/bed.hpp"
#include "render/picture/spheres/light/lamp.hpp"

namespace grainreel {

namespace {

constexpr int kSide = ShadowMap::kSide;

// Shares of the walls' colour in ground and backdrop, in front and where they meet.
constexpr double kGroundFar = 0.11, kBackdrop = 0.045;
constexpr double kBehind = 1.6;        // where the ground bends up, in sizes of the scene behind its middle
constexpr double kBend = 0.035;        // half the height of the bend, of the picture's height
constexpr double kBackdropEnds = 0.5;  // of the picture's height, above the bend

constexpr double kSteep = 0.02;  // sine of an angle between camera and level, or camera and plumb line

float rim(int cell) {
    const int inside = std::min(2 * cell + 1, 2 * (kSide - cell) - 1);  // half cells
    const float t = std::min(8 * static_cast<float>(inside) / kSide, 1.0f);
    return t * t * (3 - 2 * t);
}

// The share that is left near the picture's rim. It is 1 from a fifth of the height inside the rim on, so
// that no line shows where the picture ends.
float margin(int pixel, int size, int height) {
    const float inside = std::min(static_cast<float>(pixel) + 0.5f, static_cast<float>(size - pixel) - 0.5f);
    const float t = std::min(5 * inside / static_cast<float>(height), 1.0f);
    return t * t * (3 - 2 * t);
}

double smooth(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

std::uint32_t packed(const Colour& colour) {
    const auto byte = [](double value) { return static_cast<std::uint32_t>(std::lround(255 * value)); };
    return byte(colour.red) | byte(colour.green) << 8 | byte(colour.blue) << 16 | 0xff000000u;
}

}  // namespace

Ground::Ground(const FilmedScene& scene, const Palette& palette, const Rectangle& port)
    : map_(scene),
      background_(palette.background),
      tint_(palette.solid),
      middle_(extent_of(scene).middle()),
      size_(extent_of(scene).size().norm()),
      port_(port),
      width_(port.width),
      height_(port.height),
      tone_(static_cast<std::size_t>(scene.film.height)),
      dark_(kStride * kStride) {
    for (int cell = 0; cell < kSide; ++cell) rim_.push_back(rim(cell));
    for (int x = 0; x < width_; ++x) across_.push_back(margin(x, width_, height_));
}

void Ground::update(const State& frame, const View& view) {
    const Lamp lamp;
    view_ = view;
    map_.cast(frame, lamp.to_key[0] * view.right + lamp.to_key[1] * view.up + lamp.to_key[2] * view.forward);
    darken();
    part_ = where();
}

// How much a line of sight through a row rises, for one unit along the camera's direction.
double Ground::rise(double y) const {
    const Vec3 up = map_.in_lab({0, 0, 1});
    if (view_.orthographic) return view_.forward.dot(up);
    return view_.forward.dot(up) + (0.5 * height_ - y) / view_.focal * view_.up.dot(up);
}

// The row of the picture in which the ground bends up; below the picture where the eye sees no ground. A
// level camera with parallel lines of sight sees the ground as a line.
double Ground::bend() const {
    const Vec3 up = map_.in_lab({0, 0, 1});
    const Vec3 level = view_.forward - view_.forward.dot(up) * up;
    const double above = map_.on_level(view_.eye).z() - map_.height(), nowhere = 1e9;
    if (above <= 0 || level.norm() < kSteep) return above <= 0 ? nowhere : -nowhere;
    const Vec3 ahead = level.normalized();
    Vec3 foot = middle_ + kBehind * size_ * ahead;
    foot += (map_.height() - foot.dot(up)) * up;
    if (view_.orthographic && view_.forward.dot(up) > -kSteep) foot -= kBehind * size_ * ahead;  // edge-on
    if (view_.orthographic) return port_.y + view_.project(foot).y();
    return view_.to_view(foot).z() > 0 ? port_.y + view_.project(foot).y() : -nowhere;
}

void Ground::stand(const View& view) {
    view_ = view;
    const double strength = luminance(background_) > 0.18 ? 1 : kMostGroundInTheDark / kMostGround;
    const double row = bend(), height = static_cast<double>(tone_.size());
    for (std::size_t y = 0; y < tone_.size(); ++y) {
        const double below = (static_cast<double>(y) + 0.5 - row) / height;  // in heights of the picture
        const double ground = kGroundFar + (kMostGround - kGroundFar) * smooth(below / 0.4);
        const double backdrop = kBackdrop * smooth(1 + below / kBackdropEnds);
        const double share = smooth(0.5 + 0.5 * below / kBend);
        tone_[y] = strength * (backdrop + (ground - backdrop) * share);
    }
}

namespace {

double whole_levels(double value) {
    return static_cast<double>(std::lround(255 * value)) / 255;
}

}  // namespace

// What is lighter than the ink takes part in the tint, so that the edges of letters are as smooth as before.
void Ground::tint(const Rectangle& part, Picture& picture) const {
    const bool light = luminance(background_) > 0.18;
    const std::array<double, 3> plain{background_.red, background_.green, background_.blue};
    std::array<std::array<std::uint8_t, 256>, 3> table;
    std::uint32_t last = 0;
    for (int y = part.y; y < part.y + part.height; ++y) {
        const Colour here = mix(background_, tint_, tone_[y]);
        if (const std::uint32_t now = packed(here); now != last) {
            // The colour of all rows that are packed alike, so that a part is tinted as the whole picture is.
            const std::array<double, 3> colour{whole_levels(here.red), whole_levels(here.green),
                                               whole_levels(here.blue)};
            for (std::size_t c = 0; c < 3; ++c)
                for (int v = 0; v < 256; ++v) {
                    const double value = light ? v * colour[c] / plain[c]
                                               : v + (255 - v) * (colour[c] - plain[c]) / (1 - plain[c]);
                    table[c][v] = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
                }
            last = now;
        }
        std::uint8_t* pixel = picture.pixel(part.x, y);
        for (int x = 0; x < part.width; ++x, pixel += 4)
            for (std::size_t c = 0; c < 3; ++c) pixel[c] = table[c][pixel[c]];
    }
}

// What the ground loses of its light, as the eye sees it.
void Ground::darken() {
    constexpr float kSeen = 0.5f;  // in levels of 255; weaker shadows are not seen
    const Lamp lamp;
    const float key = lamp.key * 0.6f, sky = lamp.sky;
    int left = kSide, right = 0, low = kSide, high = 0;
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
            const auto c = static_cast<std::size_t>(j * kSide + i);
            const float light = (sky * (1 - map_.closed()[c]) + key * (1 - map_.cells()[c])) / (sky + key);
            const float dark = 255 * rim_[i] * rim_[j] * (1 - std::sqrt(light));
            dark_[(j + 1) * kStride + i + 1] = dark;
            if (dark < kSeen) continue;
            left = std::min(left, i), right = std::max(right, i + 1);
            low = std::min(low, j), high = std::max(high, j + 1);
        }
    dark_cells_ = {left, low, std::max(0, right - left), std::max(0, high - low)};
}

Vec3 Ground::on_ground(double u, double v) const {
    return map_.in_lab({map_.low().x() + u * map_.side(), map_.low().y() + v * map_.side(), map_.height()});
}

// The pixels that may show the shadow: all below the horizon where a corner of the map lies behind the eye,
// and none when the eye is below the ground.
Rectangle Ground::where() const {
    constexpr double kFlattest = 1e-3;
    if (dark_cells_.width == 0 || map_.on_level(view_.eye).z() < map_.height()) return {};
    constexpr int kMargin = 1;  // cells, as far as the filter reaches
    constexpr double side = kSide;
    const auto ends = [](int first, int count) {
        return std::array{std::max(0, first - kMargin), std::min(kSide, first + count + kMargin)};
    };
    Eigen::Array2d low(width_, height_), high(0, 0);
    bool before = true;
    for (const int i : ends(dark_cells_.x, dark_cells_.width))
        for (const int j : ends(dark_cells_.y, dark_cells_.height)) {
            const Vec3 corner = on_ground(i / side, j / side);
            before = before && (view_.orthographic || view_.to_view(corner).z() > 0.01 * size_);
            const Eigen::Array2d pixel = view_.project(corner);
            low = low.min(pixel);
            high = high.max(pixel);
        }
    if (!before) low = {0, 0}, high = {width_, height_};
    Eigen::Array2i from = low.max(0).floor().cast<int>();
    const Eigen::Array2i to = high.min(Eigen::Array2d(width_, height_)).ceil().cast<int>();
    while (from.y() < to.y() && rise(from.y() + 0.5) > -kFlattest) ++from.y();
    return {from.x(), from.y(), std::max(0, to.x() - from.x()), std::max(0, to.y() - from.y())};
}

// Where a pixel's line of sight meets the ground: the cell (u/w, v/w) of the map. The result (u, v, w) is
// linear in x and y.
Vec3 Ground::seen_at(double x, double y) const {
    const Vec3 beside = ((x - 0.5 * width_) * view_.right + (0.5 * height_ - y) * view_.up) / view_.focal;
    const Vec3 from = map_.on_level(view_.orthographic ? Vec3(view_.eye + beside) : view_.eye);
    const Vec3 along = map_.on_level(view_.orthographic ? view_.forward : Vec3(view_.forward + beside));
    const Eigen::Vector2d at =
        (from.head<2>() - map_.low()) * along.z() + (map_.height() - from.z()) * along.head<2>();
    return {at.x() * kSide / map_.side(), at.y() * kSide / map_.side(), along.z()};
}

void Ground::paint(int y, std::uint32_t* pixels) const {
    std::fill_n(pixels, width_, packed(mix(background_, tint_, tone_[port_.y + y])));
    shade(y, pixels);
}

void Ground::shade(int y, std::uint32_t* pixels) const {
    if (y < part_.y || y >= part_.y + part_.height) return;
    const Vec3 first = seen_at(part_.x + 0.5, y + 0.5), step = seen_at(part_.x + 1.5, y + 0.5) - first;
    // The middle of the first cell lies half a cell from the corner of the map, and one and a half cells from
    // the corner of `dark_`.
    const Vec3 shifted = first + 0.5 * first.z() * Vec3(1, 1, 0),
               shifted_step = step + 0.5 * step.z() * Vec3(1, 1, 0);
    shade_row({dark_.data(), kStride}, {shifted.cast<float>(), shifted_step.cast<float>()},
              across_.data() + part_.x, margin(y, height_, height_), pixels + part_.x, part_.width);
}

}  // namespace grainreel
