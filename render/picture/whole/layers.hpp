// The layers of a picture: those that OpenGL draws, how all layers are laid over each other, and how pictures
// of the moments while a shutter is open become one picture (motion blur).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/team.hpp"
#include "render/picture/base/canvas.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/container/ground.hpp"
#include "render/picture/gl/opengl.hpp"
#include "render/picture/spheres/layer.hpp"
#include "render/picture/spheres/light/wall_light.hpp"
#include "render/picture/words/overlay.hpp"

namespace grainreel {

// The layers of a picture from the lowest to the highest. All are as large as the port, and have colours
// multiplied by alpha.
struct Layers {
    std::uint32_t background;
    const Ground* ground;  // in place of the background; may be null
    const Layer& behind;
    const WallLight* wall_light;  // darkens `behind` and what is seen through it; may be null
    const Layer* meshes_behind;   // over `behind`; may be null
    const Layer& grains;
    const Layer* ghosts;         // laid over the grains at a part of their strength; may be null
    const Layer* meshes_before;  // under `before`; may be null
    const Layer& before;
    const Layer* marks;                           // over all others; may be null
    const std::vector<std::uint32_t>& strengths;  // strength of grains in each row, 0 to 255; empty: full
};

// Puts the layers into the port's part of the picture.
void compose(const Layers& layers, const Rectangle& port, Picture& picture, Team& team);

// The words beside the port, as the overlay wrote them.
struct WrittenWords {
    const Picture& picture;
    const Overlay& overlay;
    const PictureLayout& layout;
    const Ground* ground;  // it tints what lies beside the port; may be null
    bool camera_moves;
};
// Copies them into a picture. One that has been drawn into before already has most of them.
void lay_words(const WrittenWords& words, Picture& into);

// Many moments in one picture, as a shutter that stays open sees them: their mean in linear light.
class Exposure {
  public:
    explicit Exposure(const Rectangle& port);  // the part of the pictures that is exposed

    void add(const Picture& picture);  // at most 65,535 pictures before develop()
    // Puts the mean of all that was added into the picture, and begins anew.
    void develop(Picture& picture);

  private:
    const Rectangle port_;
    std::uint32_t count_ = 0;
    // Four sums for each pixel: red, green and blue (linear light of 16 bits, times alpha), then alpha (8
    // bits).
    std::vector<std::uint32_t> sum_;
};

// The layer that OpenGL draws on one side of the grains. It is drawn and read again only when its shapes have
// changed.
class SideLayer {
  public:
    // The layer is as large as the port.
    SideLayer(const gl::Functions& gl, const Rectangle& port);

    // Draws the layer. Changes that others make in it stay until the shapes change.
    const Layer& draw(const ShapePainter& painter, const Shapes& shapes);
    Layer& layer() { return layer_; }

  private:
    void bind(const Rectangle& part);
    void forget_beside(const Rectangle& part);

    const gl::Functions& gl_;
    const int width_, height_;
    std::optional<gl::Framebuffer> target_;  // target for a part of the layer
    Shapes last_;
    Layer layer_;
};

}  // namespace grainreel
