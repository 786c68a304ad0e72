#include "render/draw/ground.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/draw/container_drawing.hpp"
#include "render/draw/drawing_kit.hpp"
#include "render/spheres/lamp.hpp"

namespace grainreel {
namespace {

constexpr double kLeastRise = 0.25;  // of the key light above the horizon, or shadows would run away

double floor_reach(const Container& container) {
    const double half_depth =
        container.shape == Container::Shape::cylinder ? container.half_width : 0.5 * container.depth;
    return std::hypot(outer_floor_half_width(container), half_depth) + drawn_thickness(container);
}

// Of kSide numbers each, added one after the other.
void mean_of_five(const std::array<const float*, 5>& of, float* out) {
    const auto [a, b, c, d, e] = of;
    for (int i = 0; i < ShadowMap::kSide; ++i) out[i] = (a[i] + b[i] + c[i] + d[i] + e[i]) / 5;
}

}  // namespace

ShadowMap::ShadowMap(const Scene& scene)
    : container_(scene.container),
      low_plate_(-1.4 * drawn_thickness(scene.container)),
      cells_(kSide * kSide) {
    const double stroke =
        scene.drive.present ? scene.drive.amplitude * std::abs(scene.drive.direction.z()) : 0;
    height_ = low_plate_ - stroke - 0.15 * drawn_thickness(container_);
}

Eigen::Vector2d ShadowMap::fall(const Vec3& point, const Vec3& to_key) const {
    const Eigen::Vector2d along = to_key.head<2>() / std::max(to_key.z(), kLeastRise);
    const Eigen::Vector2d at = point.head<2>() - (point.z() - height_) * along;
    return (at - low_) * (kSide / side_);
}

// Around the foot and as far as the container's whole height throws.
void ShadowMap::place(const Vec3& to_key) {
    const double reach =
        std::max(floor_reach(container_), std::hypot(container_.half_width, 0.5 * container_.depth));
    low_ = {0, 0};
    side_ = kSide;  // one cell a metre: fall() then is in metres
    const Eigen::Vector2d tip = fall({0, 0, container_.height}, to_key);
    const Eigen::Vector2d low = tip.cwiseMin(Eigen::Vector2d::Zero()),
                          high = tip.cwiseMax(Eigen::Vector2d::Zero());
    const Eigen::Vector2d middle = 0.5 * (low + high);
    side_ = (high - low).maxCoeff() + 2.8 * reach;
    low_ = middle.array() - 0.5 * side_;
}

// The floor's plate, dense at its foot.
void ShadowMap::add_plate(const Frame& frame, const Vec3& to_key) {
    const double half = outer_floor_half_width(container_), cell = side_ / kSide;
    const bool round = container_.shape == Container::Shape::cylinder;
    const double half_depth = round ? half : 0.5 * container_.depth;
    for (const double z : {low_plate_, 0.5 * low_plate_, 0.0}) {
        const Eigen::Vector2d at = fall(Vec3(0, 0, z) + frame.floor_offset, to_key);
        for (int j = 0; j < kSide; ++j)
            for (int i = 0; i < kSide; ++i) {
                const double x = (i + 0.5 - at.x()) * cell, y = (j + 0.5 - at.y()) * cell;
                const double out =
                    round ? std::hypot(x, y) - half : std::max(std::abs(x) - half_depth, std::abs(y) - half);
                const double cover = std::clamp(0.5 - out / cell, 0.0, 1.0);
                float& taken = cells_[static_cast<std::size_t>(j) * kSide + i];
                taken = std::max(taken, static_cast<float>(4 * cover));
            }
    }
}

// Each grain as what its disc covers, shared between four cells; optical depths add up.
void ShadowMap::add_grains(const Frame& frame, const Vec3& to_key) {
    const double per_area = std::pow(kSide / side_, 2);
    for (std::size_t g = 0; g < frame.size(); ++g) {
        const Eigen::Vector2d at = fall(frame.position[g], to_key).array() - 0.5;
        const Eigen::Vector2d base = at.array().floor();
        if ((base.array() < 0).any() || (base.array() >= kSide - 1).any()) continue;
        const Eigen::Vector2d share = at - base;
        const double depth = std::numbers::pi * frame.radius[g] * frame.radius[g] * per_area;
        float* cell =
            &cells_[static_cast<std::size_t>(base.y()) * kSide + static_cast<std::size_t>(base.x())];
        cell[0] += static_cast<float>(depth * (1 - share.x()) * (1 - share.y()));
        cell[1] += static_cast<float>(depth * share.x() * (1 - share.y()));
        cell[kSide] += static_cast<float>(depth * (1 - share.x()) * share.y());
        cell[kSide + 1] += static_cast<float>(depth * share.x() * share.y());
    }
}

// Three box filters after each other, along both axes; beyond the map there is no shadow.
void ShadowMap::soften() {
    constexpr int kTimes = 3;
    constexpr auto side = static_cast<std::size_t>(kSide);
    std::array<float, side + 4> row{};
    for (std::size_t j = 0; j < side; ++j)
        for (int time = 0; time < kTimes; ++time) {
            float* cells = &cells_[j * side];
            std::copy_n(cells, side, &row[2]);
            mean_of_five({&row[0], &row[1], &row[2], &row[3], &row[4]}, cells);
        }
    const std::array<float, side> none{};
    for (int time = 0; time < kTimes; ++time) {
        before_ = cells_;
        const auto at = [&](std::size_t j) { return j < side ? &before_[j * side] : none.data(); };
        for (std::size_t j = 0; j < side; ++j)
            mean_of_five({at(j - 2), at(j - 1), at(j), at(j + 1), at(j + 2)}, &cells_[j * side]);
    }
}

void ShadowMap::cast(const Frame& frame, const Vec3& to_key) {
    place(to_key);
    std::fill(cells_.begin(), cells_.end(), 0.0f);
    add_grains(frame, to_key);
    add_plate(frame, to_key);
    for (float& cell : cells_) cell = 1 - std::exp(-cell);
    soften();
}

namespace {

const char* const vertex_source = R"(#version 330 core
layout(location = 0) in vec4 position;  // clip coordinates
layout(location = 1) in vec2 place;     // on the map, 0 to 1
out vec2 at;
void main() {
    at = place;
    gl_Position = position;
}
)";

// Fades towards the rim of the picture, so that no line shows where it ends.
const char* const fragment_source = R"(#version 330 core
in vec2 at;
uniform sampler2D taken;
uniform vec2 size;
out vec4 result;
void main() {
    vec2 margin = clamp(min(gl_FragCoord.xy, size - gl_FragCoord.xy) * (12.0 / size.y), 0.0, 1.0);
    result = vec4(0.0, 0.0, 0.0, texture(taken, at).x * margin.x * margin.y);
}
)";

// Towards the rim of the map it fades, too.
float rim(int cell) {
    const int inside = std::min(2 * cell + 1, 2 * (ShadowMap::kSide - cell) - 1);  // half cells
    const float t = std::min(5 * static_cast<float>(inside) / ShadowMap::kSide, 1.0f);
    return t * t * (3 - 2 * t);
}

}  // namespace

GroundPainter::GroundPainter(const gl::Functions& gl, const Scene& scene)
    : gl_(gl),
      map_(scene),
      program_(gl, "ground", vertex_source, fragment_source),
      array_(gl),
      corners_(gl),
      texture_(gl, ShadowMap::kSide, ShadowMap::kSide, {GL_R8, GL_RED, GL_UNSIGNED_BYTE}),
      strength_(scene.film.look.style == FilmLook::Style::dark ? 0.75f : 0.30f),
      bytes_(ShadowMap::kSide * ShadowMap::kSide) {
    for (int cell = 0; cell < ShadowMap::kSide; ++cell) rim_[static_cast<std::size_t>(cell)] = rim(cell);
    gl_.BindTexture(GL_TEXTURE_2D, texture_.id());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl_.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
    array_.bind();
    corners_.bind();
    for (const GLuint attribute : {0u, 1u}) {
        gl_.EnableVertexAttribArray(attribute);
        gl_.VertexAttribPointer(attribute, attribute == 0 ? 4 : 2, GL_FLOAT, GL_FALSE, 6 * sizeof(float),
                                reinterpret_cast<const void*>(attribute * 4 * sizeof(float)));
    }
}

void GroundPainter::update(const Frame& frame, const View& view) {
    const Lamp lamp;
    const Vec3 to_key =
        lamp.to_key[0] * view.right + lamp.to_key[1] * view.up + lamp.to_key[2] * view.forward;
    map_.cast(frame, to_key);
    int left = ShadowMap::kSide, right = 0, low = ShadowMap::kSide, high = 0;
    for (int j = 0; j < ShadowMap::kSide; ++j)
        for (int i = 0; i < ShadowMap::kSide; ++i) {
            const auto cell = static_cast<std::size_t>(j * ShadowMap::kSide + i);
            bytes_[cell] =
                static_cast<std::uint8_t>(255 * strength_ * rim_[static_cast<std::size_t>(i)] *
                                              rim_[static_cast<std::size_t>(j)] * map_.cells()[cell] +
                                          0.5f);
            if (bytes_[cell] == 0) continue;
            left = std::min(left, i), right = std::max(right, i + 1);
            low = std::min(low, j), high = std::max(high, j + 1);
        }
    dark_ = {left, low, std::max(0, right - left), std::max(0, high - low)};
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, texture_.id());
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, ShadowMap::kSide, ShadowMap::kSide, GL_RED, GL_UNSIGNED_BYTE,
                      bytes_.data());
}

Vec3 GroundPainter::on_ground(double u, double v) const {
    return {map_.low().x() + u * map_.side(), map_.low().y() + v * map_.side(), map_.height()};
}

// From below there is no ground, nor where a corner of the map lies behind the eye.
bool GroundPainter::is_seen(const View& view) const {
    if (view.eye.z() < map_.height()) return false;
    for (int corner = 0; corner < 4 && !view.orthographic; ++corner)
        if (view.to_view(on_ground(corner & 1, corner >> 1)).z() <= 0) return false;
    return true;
}

Rectangle GroundPainter::where(const View& view) const {
    if (dark_.width == 0 || !is_seen(view)) return {};
    constexpr int kMargin = 1;     // cells, as far as the filter reaches
    constexpr double kMost = 1e6;  // pixels
    constexpr double side = ShadowMap::kSide;
    Eigen::Vector2d low(kMost, kMost), high = -low;
    for (const int i :
         {std::max(0, dark_.x - kMargin), std::min(ShadowMap::kSide, dark_.x + dark_.width + kMargin)})
        for (const int j :
             {std::max(0, dark_.y - kMargin), std::min(ShadowMap::kSide, dark_.y + dark_.height + kMargin)}) {
            const Eigen::Vector2d pixel = view.project(on_ground(i / side, j / side));
            low = low.cwiseMin(pixel.cwiseMax(-kMost));
            high = high.cwiseMax(pixel.cwiseMin(kMost));
        }
    const Eigen::Vector2i from = low.array().floor().cast<int>(), to = high.array().ceil().cast<int>();
    return {from.x(), from.y(), to.x() - from.x(), to.y() - from.y()};
}

void GroundPainter::paint(const View& view) const {
    if (!is_seen(view)) return;
    std::vector<float> corners;
    for (int corner = 0; corner < 4; ++corner) {
        const double u = corner & 1, v = corner >> 1;
        const Vec3 seen = view.to_view(on_ground(u, v));
        const double w = view.orthographic ? 1 : seen.z();
        for (const double value : {2 * view.focal * seen.x() / view.port.width,
                                   -2 * view.focal * seen.y() / view.port.height, 0.0, w, u, v})  // upside down
            corners.push_back(static_cast<float>(value));
    }
    array_.bind();
    corners_.fill(corners.data(), corners.size() * sizeof corners[0]);
    program_.use();
    program_.set("taken", 0);
    program_.set("size", static_cast<float>(view.port.width), static_cast<float>(view.port.height));
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, texture_.id());
    gl_.Enable(GL_BLEND);
    gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    gl_.Disable(GL_BLEND);
}

}  // namespace grainreel
