#include "render/draw/side_layer.hpp"

#include <algorithm>
#include <cmath>

namespace grainreel {
namespace {

constexpr gl::TextureFormat bytes{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};

bool empty(const Rectangle& part) {
    return part.width <= 0 || part.height <= 0;
}

std::int64_t area(const Rectangle& part) {
    return static_cast<std::int64_t>(part.width) * part.height;
}

Rectangle hull(const Rectangle& a, const Rectangle& b) {
    if (empty(a)) return b;
    if (empty(b)) return a;
    const int x = std::min(a.x, b.x), y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

// Of what lies between the two corners, the pixels that a layer has.
Rectangle on_layer(float x0, float y0, float x1, float y1, int width, int height) {
    const auto pixel = [](float at, int size) {
        return static_cast<int>(std::clamp(at, 0.0f, static_cast<float>(size)));
    };
    const int x = pixel(std::floor(x0), width), y = pixel(std::floor(y0), height);
    return {x, y, pixel(std::ceil(x1), width) - x, pixel(std::ceil(y1), height) - y};
}

Rectangle area_of(const Shapes& shapes, int width, int height) {
    if (shapes.vertices().empty()) return {};
    float x0 = 1e9f, y0 = 1e9f, x1 = -1e9f, y1 = -1e9f;
    for (const Shapes::Vertex& v : shapes.vertices()) {
        x0 = std::min(x0, v.x), x1 = std::max(x1, v.x);
        y0 = std::min(y0, v.y), y1 = std::max(y1, v.y);
    }
    return on_layer(x0, y0, x1, y1, width, height);
}

}  // namespace

SideLayer::SideLayer(const gl::Functions& gl, const Rectangle& port, const std::array<float, 4>& clear_colour)
    : gl_(gl),
      target_(gl, port.width, port.height, bytes),
      clear_colour_(clear_colour),
      width_(port.width),
      height_(port.height),
      pixels_(static_cast<std::size_t>(port.width) * port.height) {}

// Notes what will have been drawn.
Rectangle SideLayer::part_to_draw(const Shapes& shapes, const Under& under) {
    const Rectangle place = under.paint ? under.where : Rectangle();
    const Rectangle below = on_layer(static_cast<float>(place.x), static_cast<float>(place.y),
                                     static_cast<float>(place.x + place.width),
                                     static_cast<float>(place.y + place.height), width_, height_);
    Rectangle part = hull(below, last_under_);
    last_under_ = below;
    if (drawn_ && shapes == last_) return part;
    const Rectangle above = area_of(shapes, width_, height_);
    part = drawn_ ? hull(part, hull(above, last_shapes_)) : Rectangle{0, 0, width_, height_};
    last_shapes_ = above;
    last_ = shapes;
    drawn_ = true;
    return part;
}

void SideLayer::draw_within(const Rectangle& part) const {
    gl_.Scissor(part.x, height_ - part.y - part.height, part.width, part.height);
}

void SideLayer::draw(const ShapePainter& painter, const Shapes& shapes, const Under& under) {
    const Rectangle part = part_to_draw(shapes, under);
    if (empty(part)) return;
    target_.bind();
    // llvmpipe draws a rectangle to clear a part, which for more than a quarter takes longer than to clear
    // all. (What is kept of the rest is in pixels_.)
    const bool large = 4 * area(part) > static_cast<std::int64_t>(width_) * height_;
    if (large) gl_.ClearBufferfv(GL_COLOR, 0, clear_colour_.data());
    gl_.Enable(GL_SCISSOR_TEST);
    draw_within(part);
    if (!large) gl_.ClearBufferfv(GL_COLOR, 0, clear_colour_.data());
    if (under.paint) {
        draw_within(last_under_);  // of its pixels most would be clear
        under.paint();
        draw_within(part);
    }
    painter.paint(shapes, width_, height_);
    gl_.Disable(GL_SCISSOR_TEST);
    stale_ = hull(stale_, part);
}

std::vector<std::uint32_t>& SideLayer::read() {
    if (empty(stale_)) return pixels_;
    const int below = height_ - stale_.y - stale_.height;
    target_.bind();
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.PixelStorei(GL_PACK_ROW_LENGTH, width_);
    gl_.ReadPixels(stale_.x, below, stale_.width, stale_.height, GL_RGBA, GL_UNSIGNED_BYTE,
                   pixels_.data() + static_cast<std::size_t>(below) * width_ + stale_.x);
    gl_.PixelStorei(GL_PACK_ROW_LENGTH, 0);
    stale_ = {};
    return pixels_;
}

}  // namespace grainreel
