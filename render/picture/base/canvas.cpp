// Flat shapes: how lines and polygons become triangles, and the shaders that paint them.
#include "render/picture/base/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

// Everything here is drawn upside down, so that the first row of OpenGL is the first row of the picture.
const char* const vertex_source = R"(#version 330 core
layout(location = 0) in vec2 position;  // pixels from the top left
layout(location = 1) in vec2 edge;
layout(location = 2) in vec4 colour;
uniform vec2 size;
noperspective out vec2 to_edge;
flat out vec4 paint;
void main() {
    to_edge = edge;
    paint = colour;
    gl_Position = vec4(2.0 * position.x / size.x - 1.0, 2.0 * position.y / size.y - 1.0, 0.0, 1.0);
}
)";

const char* const fragment_source = R"(#version 330 core
noperspective in vec2 to_edge;  // distance from the middle of the line, half its width
flat in vec4 paint;
out vec4 result;
void main() {
    float coverage = clamp(to_edge.y + 0.5 - abs(to_edge.x), 0.0, 1.0) * min(1.0, 2.0 * to_edge.y);
    float alpha = paint.a * coverage;
    result = vec4(paint.rgb * alpha, alpha);
}
)";

Shapes::Vertex vertex(const Pixel& at, double across, double half_width, const Paint& paint) {
    return {static_cast<float>(at.x()),
            static_cast<float>(at.y()),
            static_cast<float>(across),
            static_cast<float>(half_width),
            static_cast<float>(paint.colour.red),
            static_cast<float>(paint.colour.green),
            static_cast<float>(paint.colour.blue),
            static_cast<float>(paint.alpha)};
}

Pixel left_of(const Pixel& from, const Pixel& to) {
    const Pixel along = to - from;
    const double length = std::max(along.norm(), 1e-9);
    return {-along.y() / length, along.x() / length};
}

constexpr double inside = 1e6;  // pixels; stands for "far from any edge"

}  // namespace

std::vector<Pixel> circle_corners(const Pixel& middle, double radius, int corners) {
    std::vector<Pixel> ring;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2 * std::numbers::pi * k / corners;
        ring.push_back(middle + radius * Pixel(std::cos(angle), std::sin(angle)));
    }
    return ring;
}

void Shapes::polygon(const std::vector<Pixel>& corners, const Paint& paint) {
    for (std::size_t i = 2; i < corners.size(); ++i)
        for (const std::size_t corner : {std::size_t{0}, i - 1, i})
            vertices_.push_back(vertex(corners[corner], 0, inside, paint));
}

void Shapes::line(const std::vector<Pixel>& points, bool closed, double width, const Paint& paint) {
    const std::size_t count = points.size();
    if (count < 2) return;
    const double half = 0.5 * width, reach = half + 1;
    constexpr double mitre_limit = 0.35;  // cosine of half the turn; below it a corner is cut short

    std::vector<Pixel> mitre(count);
    for (std::size_t i = 0; i < count; ++i) {
        const bool first = i == 0 && !closed, last = i + 1 == count && !closed;
        const Pixel before =
            first ? left_of(points[0], points[1]) : left_of(points[(i + count - 1) % count], points[i]);
        const Pixel after = last ? before : left_of(points[i], points[(i + 1) % count]);
        const Pixel sum = (before + after).normalized();
        mitre[i] = sum / std::max(mitre_limit, sum.dot(after));
    }
    for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i) {
        const std::size_t j = (i + 1) % count;
        const Vertex a = vertex(points[i] + reach * mitre[i], reach, half, paint);
        const Vertex b = vertex(points[i] - reach * mitre[i], -reach, half, paint);
        const Vertex c = vertex(points[j] + reach * mitre[j], reach, half, paint);
        const Vertex d = vertex(points[j] - reach * mitre[j], -reach, half, paint);
        vertices_.insert(vertices_.end(), {a, b, c, c, b, d});
    }
}

ShapePainter::ShapePainter(const gl::Functions& gl)
    : gl_(gl), program_(gl, "shapes", vertex_source, fragment_source), array_(gl), buffer_(gl) {
    array_.bind();
    buffer_.bind();
    const auto attribute = [&](GLuint index, GLint size, std::size_t offset) {
        gl_.EnableVertexAttribArray(index);
        gl_.VertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(Shapes::Vertex),
                                reinterpret_cast<const void*>(offset));
    };
    attribute(0, 2, offsetof(Shapes::Vertex, x));
    attribute(1, 2, offsetof(Shapes::Vertex, across));
    attribute(2, 4, offsetof(Shapes::Vertex, red));
}

void ShapePainter::paint(const Shapes& shapes, int width, int height) const {
    if (shapes.vertices().empty()) return;
    array_.bind();
    buffer_.fill(shapes.vertices().data(), shapes.vertices().size() * sizeof(Shapes::Vertex));
    program_.use();
    program_.set("size", static_cast<float>(width), static_cast<float>(height));
    gl_.Enable(GL_BLEND);
    gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(shapes.vertices().size()));
    gl_.Disable(GL_BLEND);
}

// The painter's objects belong to the context, so it must be current.
DrawingContext::~DrawingContext() {
    try {
        context->make_current();
    } catch (const RunError&) {
        // If no context is current, all that the context owns is deleted with the context itself.
    }
}

}  // namespace grainreel
