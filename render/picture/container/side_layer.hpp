// What OpenGL draws on one side of the grains: drawn again, and read again, only when it has changed.
#pragma once

#include <optional>

#include "render/picture/base/canvas.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/gl/objects.hpp"
#include "render/picture/spheres/layer.hpp"

namespace grainreel {

class SideLayer {
  public:
    // As large as the port.
    SideLayer(const gl::Functions& gl, const Rectangle& port);

    // What is changed in the layer stays until it is drawn again.
    const Layer& draw(const ShapePainter& painter, const Shapes& shapes);
    Layer& layer() { return layer_; }

  private:
    void bind(const Rectangle& part);
    void forget_beside(const Rectangle& part);

    const gl::Functions& gl_;
    const int width_, height_;
    std::optional<gl::Framebuffer> target_;  // of a part of the layer
    Shapes last_;
    Layer layer_;
};

}  // namespace grainreel
