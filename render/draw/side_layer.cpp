#include "render/draw/side_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

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

SideLayer::SideLayer(const gl::Functions& gl, const Rectangle& port)
    : gl_(gl),
      target_(gl, port.width, port.height, bytes),
      width_(port.width),
      height_(port.height),
      layer_(port.width, port.height) {}

// Notes what will have been drawn; where that differs from what is there.
Rectangle SideLayer::part_to_draw(const Shapes& shapes) {
    if (drawn_ && shapes == last_) return {};
    const Rectangle now = area_of(shapes, width_, height_);
    const Rectangle part = drawn_ ? hull(now, last_part_) : Rectangle{0, 0, width_, height_};
    last_part_ = now;
    last_ = shapes;
    drawn_ = true;
    return part;
}

const Layer& SideLayer::draw(const ShapePainter& painter, const Shapes& shapes) {
    const Rectangle part = part_to_draw(shapes);
    if (empty(part)) return layer_;
    target_.bind();
    // llvmpipe draws a rectangle to clear a part, which for more than a quarter takes longer than to clear
    // all.
    const bool large = 4 * area(part) > static_cast<std::int64_t>(width_) * height_;
    gl_.Scissor(part.x, part.y, part.width, part.height);
    if (!large) gl_.Enable(GL_SCISSOR_TEST);
    constexpr std::array<float, 4> clear{0, 0, 0, 0};
    gl_.ClearBufferfv(GL_COLOR, 0, clear.data());
    painter.paint(shapes, width_, height_);
    gl_.Disable(GL_SCISSOR_TEST);
    read(part);
    return layer_;
}

void SideLayer::read(const Rectangle& part) {
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.PixelStorei(GL_PACK_ROW_LENGTH, width_);
    gl_.ReadPixels(part.x, part.y, part.width, part.height, GL_RGBA, GL_UNSIGNED_BYTE,
                   layer_.row(part.y) + part.x);
    gl_.PixelStorei(GL_PACK_ROW_LENGTH, 0);
    std::fill(layer_.spans.begin(), layer_.spans.end(), Layer::Span{});
    for (int y = last_part_.y; y < last_part_.y + last_part_.height; ++y)
        layer_.spans[static_cast<std::size_t>(y)] = {last_part_.x, last_part_.x + last_part_.width};
}

}  // namespace grainreel
