// What OpenGL draws on one side of the grains: drawn again, and read again, only when it has changed.
#pragma once

#include "render/draw/canvas.hpp"
#include "render/draw/view.hpp"
#include "render/gl/objects.hpp"
#include "render/spheres/layer.hpp"

namespace grainreel {

class SideLayer {
  public:
    // As large as the port.
    SideLayer(const gl::Functions& gl, const Rectangle& port);

    // What is changed in the layer stays until it is drawn again.
    const Layer& draw(const ShapePainter& painter, const Shapes& shapes);
    Layer& layer() { return layer_; }

  private:
    Rectangle part_to_draw(const Shapes& shapes);
    void read(const Rectangle& part);

    const gl::Functions& gl_;
    gl::Framebuffer target_;
    const int width_, height_;
    bool drawn_ = false;
    Shapes last_;
    Rectangle last_part_;  // where they were drawn
    Layer layer_;
};

}  // namespace grainreel
