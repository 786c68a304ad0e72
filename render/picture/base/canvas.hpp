// Flat shapes in pixels: polygons and lines of constant width, with smooth edges, painted in the order in
// which they are added. Walls and marks are drawn with them after their projection.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "render/picture/gl/opengl.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

using Pixel = Eigen::Vector2d;  // pixels from the top left

struct Paint {
    Colour colour;  // sRGB
    double alpha = 1;
};

// Pixels: the unit in which the widths of marks over the grains are given.
inline double mark_pen(int picture_height) {
    return std::max(1.0, picture_height / 540.0);
}

// The corners of a circle.
std::vector<Pixel> circle_corners(const Pixel& middle, double radius, int corners);

// A list of shapes, made anew for every frame.
class Shapes {
  public:
    void polygon(const std::vector<Pixel>& corners, const Paint& paint);  // corners of a convex polygon
    // width: pixels. Corners are mitred, so a translucent line shows no knots.
    void line(const std::vector<Pixel>& points, bool closed, double width, const Paint& paint);
    void append(const Shapes& others) {
        vertices_.insert(vertices_.end(), others.vertices_.begin(), others.vertices_.end());
    }
    void clear() { vertices_.clear(); }

    struct Vertex {
        float x, y;  // pixels
        float across,
            half_width;  // pixels: distance from the line's middle, with its sign; half the line's width
        float red, green, blue, alpha;  // sRGB, not premultiplied
        bool operator==(const Vertex&) const = default;
    };
    bool operator==(const Shapes&) const = default;
    const std::vector<Vertex>& vertices() const { return vertices_; }

  private:
    std::vector<Vertex> vertices_;  // triangles
};

// Paints shapes into the framebuffer that is bound, whose size is width x height.
class ShapePainter {
  public:
    explicit ShapePainter(const gl::Functions& gl);
    void paint(const Shapes& shapes, int width, int height) const;

  private:
    const gl::Functions& gl_;
    gl::Program program_;
    gl::VertexArray array_;
    gl::Buffer buffer_;
};

// An OpenGL context with the shapes' painter. To make one takes about 80 ms of a processor, most of it for
// compiling, so renderers on one thread that follow each other may have the same one.
struct DrawingContext {
    DrawingContext(gl::Provider provider, int raster_threads)
        : context(gl::make_context(provider, raster_threads)), shape_painter(context->gl()) {}
    ~DrawingContext();
    DrawingContext(const DrawingContext&) = delete;
    DrawingContext& operator=(const DrawingContext&) = delete;
    std::unique_ptr<gl::Context> context;
    ShapePainter shape_painter;
};

}  // namespace grainreel
