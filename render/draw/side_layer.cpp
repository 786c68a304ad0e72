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
      height_(port.height) {}

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
    gl_.Scissor(part.x, part.y, part.width, part.height);
}

void SideLayer::draw(const ShapePainter& painter, const Shapes& shapes, const Under& under) {
    const Rectangle part = part_to_draw(shapes, under);
    if (empty(part)) return;
    target_.bind();
    // llvmpipe draws a rectangle to clear a part, which for more than a quarter takes longer than to clear
    // all.
    const Rectangle all{0, 0, width_, height_};
    const Rectangle anew = 4 * area(part) > area(all) ? all : part;
    if (area(anew) < area(all)) gl_.Enable(GL_SCISSOR_TEST);
    draw_within(anew);
    gl_.ClearBufferfv(GL_COLOR, 0, clear_colour_.data());
    gl_.Enable(GL_SCISSOR_TEST);
    if (under.paint) {
        draw_within(last_under_);  // of its pixels most would be clear
        under.paint();
        draw_within(anew);
    }
    painter.paint(shapes, width_, height_);
    gl_.Disable(GL_SCISSOR_TEST);
    stale_ = hull(stale_, part);
}

Layer& SideLayer::read() {
    if (!layer_) layer_.emplace(width_, height_);
    if (empty(stale_)) return *layer_;
    read_part(stale_, layer_->row(stale_.y) + stale_.x, width_);
    // Beside the shapes there is nothing but the clear colour, which is clear where a layer is asked for.
    std::fill(layer_->spans.begin(), layer_->spans.end(), Layer::Span{});
    for (int y = last_shapes_.y; y < last_shapes_.y + last_shapes_.height; ++y)
        layer_->spans[static_cast<std::size_t>(y)] = {last_shapes_.x, last_shapes_.x + last_shapes_.width};
    stale_ = {};
    return *layer_;
}

void SideLayer::read_into(Picture& picture, int x, int y) const {
    read_part({0, 0, width_, height_}, picture.pixel(x, y), picture.width);
}

// row_length: pixels.
void SideLayer::read_part(const Rectangle& part, void* to, int row_length) const {
    target_.bind();
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.PixelStorei(GL_PACK_ROW_LENGTH, row_length);
    gl_.ReadPixels(part.x, part.y, part.width, part.height, GL_RGBA, GL_UNSIGNED_BYTE, to);
    gl_.PixelStorei(GL_PACK_ROW_LENGTH, 0);
}

}  // namespace grainreel
