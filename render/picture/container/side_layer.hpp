// The layer that OpenGL draws on one side of the grains. It is drawn and read again only when its shapes have
// changed.
#pragma once

#include <optional>

#include "render/picture/base/canvas.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/gl/objects.hpp"
#include "render/picture/spheres/layer.hpp"

namespace grainreel {

class SideLayer {
  public:
    // The layer is as large as the port.
    SideLayer(const gl::Functions& gl, const Rectangle& port);

    // Draws the layer. What others change in it stays until the shapes change.
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
