// The grains: exact spheres, each pixel lit once.
#pragma once

#include <optional>
#include <vector>

#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"
#include "render/draw/density_field.hpp"
#include "render/draw/view.hpp"
#include "render/gl/objects.hpp"

namespace grainreel {

class SpherePainter {
public:
    // width, height: pixels of the port.
    SpherePainter(const gl::Functions& gl, const Scene& scene, int width, int height);

    void upload(const View& view, const Frame& frame);
    void find_nearest(const View& view) const;  // first pass, into a buffer of its own
    // Second pass, over what the bound framebuffer of the port's size already holds.
    void paint(const View& view) const;

private:
    struct Box {
        float x0, y0, x1, y1;  // clip coordinates
    };
    void set_camera(const gl::Program& program, const View& view) const;
    std::optional<Box> covered(const View& view, const Frame& frame) const;

    const gl::Functions& gl_;
    const int width_, height_;
    std::vector<std::array<float, 4>> palette_;  // linear colour by species
    DensityField density_;
    gl::Program nearest_, light_;
    gl::Framebuffer seen_;
    gl::VertexArray instances_, none_;
    gl::BufferTexture spheres_, crowding_, colours_;
    std::vector<std::array<float, 4>> staging_;
    std::size_t count_ = 0;
    std::optional<Box> box_;  // where grains are; nothing when none is in sight
};

}  // namespace grainreel
