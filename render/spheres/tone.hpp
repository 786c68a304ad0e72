// From linear light to 8-bit sRGB (IEC 61966-2-1).
#pragma once

#include <array>
#include <cstdint>

namespace grainreel {

// A table over 4096 steps of linear light, each at most 0.8 of a byte's step wide.
class ToneTable {
  public:
    static const ToneTable& get();
    std::uint32_t byte(float linear) const {
        const float clamped = linear < 0 ? 0 : linear > 1 ? 1 : linear;
        return bytes_[static_cast<std::size_t>(clamped * (kSteps - 1) + 0.5f)];
    }
    // Opaque.
    std::uint32_t pixel(float red, float green, float blue) const {
        return byte(red) | byte(green) << 8 | byte(blue) << 16 | 0xff000000u;
    }

  private:
    static constexpr int kSteps = 4096;
    ToneTable();
    std::array<std::uint8_t, kSteps> bytes_{};
};

}  // namespace grainreel
