// What OpenGL draws on one side of the grains: drawn again, and read again, only where something has changed.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "render/draw/canvas.hpp"
#include "render/draw/picture.hpp"
#include "render/draw/view.hpp"
#include "render/gl/objects.hpp"
#include "render/spheres/layer.hpp"

namespace grainreel {

class SideLayer {
  public:
    // What goes under the shapes and changes from frame to frame: `paint` changes nothing outside of `where`
    // (pixels from the layer's top left). None without `paint`.
    struct Under {
        Rectangle where;
        std::function<void()> paint;
    };

    // As large as the port. clear_colour: where nothing is drawn.
    SideLayer(const gl::Functions& gl, const Rectangle& port, const std::array<float, 4>& clear_colour);

    void draw(const ShapePainter& painter, const Shapes& shapes, const Under& under);

    // What is changed there stays until it is drawn again.
    Layer& read();
    // The same into a part of a picture, as large as the layer.
    void read_into(Picture& picture, int x, int y) const;

  private:
    Rectangle part_to_draw(const Shapes& shapes, const Under& under);
    void draw_within(const Rectangle& part) const;
    void read_part(const Rectangle& part, void* to, int row_length) const;

    const gl::Functions& gl_;
    gl::Framebuffer target_;
    const std::array<float, 4> clear_colour_;
    const int width_, height_;
    Rectangle stale_;  // of layer_: drawn since the last read()
    bool drawn_ = false;
    Shapes last_;
    Rectangle last_shapes_, last_under_;  // where they were drawn
    std::optional<Layer> layer_;
};

}  // namespace grainreel
