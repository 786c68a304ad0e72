// Many moments in one picture, as a shutter that stays open sees them: their mean in linear light.
#pragma once

#include <cstdint>
#include <vector>

#include "render/picture/base/picture.hpp"
#include "render/picture/base/view.hpp"

namespace grainreel {

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
