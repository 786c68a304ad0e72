// The grains: found pixel by pixel on the processor, then lit by OpenGL, each pixel once.
#pragma once

#include <array>
#include <vector>

#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"
#include "render/draw/density_field.hpp"
#include "render/draw/view.hpp"
#include "render/draw/visibility.hpp"
#include "render/gl/objects.hpp"

namespace grainreel {

class SpherePainter {
  public:
    // width, height: pixels of the port.
    SpherePainter(const gl::Functions& gl, const Scene& scene, int width, int height);

    void find_visible(const View& view, const Frame& frame);
    void upload(const View& view, const Frame& frame);
    // Over what the bound framebuffer of the port's size already holds.
    void paint(const View& view) const;

  private:
    void upload_visibility() const;

    const gl::Functions& gl_;
    const int width_, height_;
    std::vector<std::array<float, 4>> palette_;  // linear colour by species
    DensityField density_;
    Visibility visibility_;
    gl::Program light_;
    gl::Texture seen_;
    gl::VertexArray none_;
    gl::BufferTexture spheres_, crowding_, colours_;
    std::vector<ViewSphere> view_spheres_;
    std::vector<std::array<float, 4>> staging_;
};

}  // namespace grainreel
