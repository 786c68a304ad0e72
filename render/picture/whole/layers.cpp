// Keeps the layers that OpenGL draws, lays all layers over each other, and averages the moments of an
// exposure.
#include "render/picture/whole/layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "engine/base/error.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/spheres/layer.hpp"
#include "render/picture/spheres/light/lamp.hpp"

namespace grainreel {

namespace {

constexpr std::uint32_t kGhost = 90;  // strength of a ghost, of 255

void lay_row(const Layer& layer, int y, std::uint32_t* out, std::uint32_t strength = 255) {
    const Layer::Span span = layer.spans[y];
    lay_over(out + span.begin, layer.row(y) + span.begin, span.end - span.begin, strength);
}

}  // namespace

void compose(const Layers& layers, const Rectangle& port, Picture& picture, Team& team) {
    team.run([&](int member) {
        for (int y = member; y < port.height; y += team.size()) {
            auto* out = reinterpret_cast<std::uint32_t*>(picture.pixel(port.x, port.y + y));
            if (layers.ground)
                layers.ground->paint(y, out);
            else
                std::fill_n(out, port.width, layers.background);
            lay_row(layers.behind, y, out);
            if (layers.wall_light) layers.wall_light->darken(y, out);
            if (layers.meshes_behind) lay_row(*layers.meshes_behind, y, out);
            const std::uint32_t strength = layers.strengths.empty() ? 255 : layers.strengths[y];
            lay_row(layers.grains, y, out, strength);
            if (layers.ghosts) lay_row(*layers.ghosts, y, out, kGhost * strength / 255);
            if (layers.meshes_before) lay_row(*layers.meshes_before, y, out);
            lay_row(layers.before, y, out);
            if (layers.marks) lay_row(*layers.marks, y, out);
        }
    });
}

void lay_words(const WrittenWords& words, Picture& into) {
    const Picture& from = words.picture;
    const PictureLayout& layout = words.layout;
    const auto copy = [&](const Rectangle& part) {
        copy_part(from, part, into);
        if (words.ground) words.ground->tint(part, into);
    };
    const bool fits = into.width == from.width && into.height == from.height;
    if (!fits) {
        into = from;
        if (words.ground) words.ground->tint({0, 0, from.width, from.height}, into);
    }
    if (layout.plates) {
        copy(layout.caption);
        into.still = 0;
        return;
    }
    const bool may_stay = !(words.ground && words.camera_moves);  // else the ground is another one each time
    if (fits && may_stay && into.still == words.overlay.still()) {
        for (const Rectangle& part : words.overlay.moving()) copy(part);
        return;
    }
    for (const Rectangle& part : {layout.first, layout.second, layout.caption}) copy(part);
    into.still = may_stay ? words.overlay.still() : 0;
    into.moving = words.overlay.moving();
    into.moving.push_back(layout.port);
}

namespace {

// The largest value of linear light, and the largest number of moments: their product fits in a sum of 32
// bits.
constexpr std::uint32_t kMost = 0xffff;

// The linear light of each sRGB byte, 16 bits.
const std::array<std::uint32_t, 256>& linear_of_byte() {
    static const std::array<std::uint32_t, 256> table = [] {
        std::array<std::uint32_t, 256> made{};
        for (std::size_t i = 0; i < made.size(); ++i)
            made[i] =
                static_cast<std::uint32_t>(std::lround(kMost * to_linear(static_cast<double>(i) / 255)));
        return made;
    }();
    return table;
}

}  // namespace

Exposure::Exposure(const Rectangle& port)
    : port_(port), sum_(static_cast<std::size_t>(port.width) * port.height * 4, 0) {}

void Exposure::add(const Picture& picture) {
    GRAINREEL_CHECK(count_ < kMost);
    const auto& linear = linear_of_byte();
    std::uint32_t* sum = sum_.data();
    for (int y = 0; y < port_.height; ++y) {
        const std::uint8_t* pixel = picture.pixel(port_.x, port_.y + y);
        for (int x = 0; x < port_.width; ++x, pixel += 4, sum += 4) {
            const std::uint32_t alpha = pixel[3];
            for (int c = 0; c < 3; ++c) sum[c] += (linear[pixel[c]] * alpha + 127) / 255;
            sum[3] += alpha;
        }
    }
    ++count_;
}

void Exposure::develop(Picture& picture) {
    GRAINREEL_CHECK(count_ > 0);
    const ToneTable& tone = ToneTable::get();
    const std::uint32_t* sum = sum_.data();
    for (int y = 0; y < port_.height; ++y) {
        std::uint8_t* pixel = picture.pixel(port_.x, port_.y + y);
        for (int x = 0; x < port_.width; ++x, pixel += 4, sum += 4) {
            const float alpha = static_cast<float>(sum[3]);
            const float scale = alpha > 0 ? 255.0f / (kMost * alpha) : 0.0f;
            for (int c = 0; c < 3; ++c)
                pixel[c] = static_cast<std::uint8_t>(tone.byte(scale * static_cast<float>(sum[c])));
            pixel[3] = static_cast<std::uint8_t>((sum[3] + count_ / 2) / count_);
        }
    }
    std::fill(sum_.begin(), sum_.end(), 0);
    count_ = 0;
}

namespace {

constexpr gl::TextureFormat bytes{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};

// The pixels of a layer between the corners (x0, y0) and (x1, y1).
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

// Binds a target for a part of the port. The target is no larger than needed, because clearing it takes as
// long as drawing.
void SideLayer::bind(const Rectangle& part) {
    constexpr int kStep = 64;  // pixels; slowly growing shapes do not need a new target each time
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

// Clears pixels that were drawn the last time and will not be drawn this time.
void SideLayer::forget_beside(const Rectangle& part) {
    for (int y = 0; y < height_; ++y) {
        Layer::Span& span = layer_.spans[y];
        const bool drawn = part.width > 0 && y >= part.y && y < part.y + part.height;
        const Layer::Span now = drawn ? Layer::Span{part.x, part.x + part.width} : Layer::Span{};
        std::uint32_t* row = layer_.row(y);
        for (int x = span.begin; x < span.end; ++x)
            if (x < now.begin || x >= now.end) row[x] = 0;
        span = now;
    }
}

}  // namespace grainreel
