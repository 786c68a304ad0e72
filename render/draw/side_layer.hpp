// What OpenGL draws on one side of the grains: drawn again, and read again, only where something has changed.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "render/draw/canvas.hpp"
#include "render/draw/view.hpp"
#include "render/gl/objects.hpp"

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

    // Pixels, rows from the bottom; what is changed there stays until it is drawn again.
    std::vector<std::uint32_t>& read();

  private:
    Rectangle part_to_draw(const Shapes& shapes, const Under& under);
    void draw_within(const Rectangle& part) const;

    const gl::Functions& gl_;
    gl::Framebuffer target_;
    const std::array<float, 4> clear_colour_;
    const int width_, height_;
    Rectangle stale_;  // drawn since the last read()
    bool drawn_ = false;
    Shapes last_;
    Rectangle last_shapes_, last_under_;  // where they were drawn
    std::vector<std::uint32_t> pixels_;
};

}  // namespace grainreel
