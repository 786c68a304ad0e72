// Lays the grains over what is behind them, the ground and the background, and under what is before them.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/team.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/container/ground.hpp"
#include "render/picture/spheres/layer.hpp"

namespace grainreel {

// All of the port's size; colours multiplied by alpha.
struct Layers {
    std::uint32_t background;
    const Ground* ground;  // may be null
    const Layer& behind;
    const Layer* meshes_behind;  // over `behind`; may be null
    const Layer& grains;
    const Layer* ghosts;         // laid over the grains at a part of their strength; may be null
    const Layer* meshes_before;  // under `before`; may be null
    const Layer& before;
    const Layer* marks;                           // over all others; may be null
    const std::vector<std::uint32_t>& strengths;  // of grains, 0 to 255, by row; empty: full
};

// The result goes into the port's part of the picture.
void compose(const Layers& layers, const Rectangle& port, Picture& picture, Team& team);

// Many moments in one picture, as a shutter that stays open sees them: their mean in linear light.

class Exposure {
  public:
    explicit Exposure(const Rectangle& port);  // the part of the pictures that is exposed

    void add(const Picture& picture);  // at most 65,535 a picture
    // The mean of what was added, which is forgotten.
    void develop(Picture& picture);

  private:
    const Rectangle port_;
    std::uint32_t count_ = 0;
    // A pixel: red, green and blue in linear light times alpha, then alpha; in 255ths of 16 and of 8 bits.
    std::vector<std::uint32_t> sum_;
};

}  // namespace grainreel
