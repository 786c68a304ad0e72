#include "render/picture/container/side_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace grainreel {
namespace {

constexpr gl::TextureFormat bytes{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};

// The pixels of a layer between the two corners.
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
    : gl_(gl), width_(port.width), height_(port.height), layer_(port.width, port.height) {}

const Layer& SideLayer::draw(const ShapePainter& painter, const Shapes& shapes) {
    if (shapes == last_) return layer_;
    last_ = shapes;
    const Rectangle part = area_of(shapes, width_, height_);
    forget_beside(part);
    if (part.width <= 0 || part.height <= 0) return layer_;
    bind(part);
    constexpr std::array<float, 4> clear{0, 0, 0, 0};
    gl_.ClearBufferfv(GL_COLOR, 0, clear.data());
    painter.paint(shapes, width_, height_);
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.PixelStorei(GL_PACK_ROW_LENGTH, width_);
    gl_.ReadPixels(0, 0, part.width, part.height, GL_RGBA, GL_UNSIGNED_BYTE, layer_.row(part.y) + part.x);
    gl_.PixelStorei(GL_PACK_ROW_LENGTH, 0);
    return layer_;
}

// Binds a target for a part of the port. It is no larger than need be, because to clear it takes as long as
// to draw.
void SideLayer::bind(const Rectangle& part) {
    constexpr int kStep = 64;  // pixels, so that shapes that grow slowly do not want a new one each time
    if (!target_ || part.width > target_->width() || part.height > target_->height()) {
        const auto room = [](int needed, int now) {
            return std::max(now, (needed + kStep - 1) / kStep * kStep);
        };
        const int width = room(part.width, target_ ? target_->width() : 0);
        const int height = room(part.height, target_ ? target_->height() : 0);
        target_.emplace(gl_, width, height, bytes);
    }
    target_->bind();
    gl_.Viewport(-part.x, -part.y, width_, height_);
}

// Clears what was drawn before where nothing will be drawn now.
void SideLayer::forget_beside(const Rectangle& part) {
    for (int y = 0; y < height_; ++y) {
        Layer::Span& span = layer_.spans[static_cast<std::size_t>(y)];
        const bool drawn = part.width > 0 && y >= part.y && y < part.y + part.height;
        const Layer::Span now = drawn ? Layer::Span{part.x, part.x + part.width} : Layer::Span{};
        std::uint32_t* row = layer_.row(y);
        for (int x = span.begin; x < span.end; ++x)
            if (x < now.begin || x >= now.end) row[x] = 0;
        span = now;
    }
}

}  // namespace grainreel
