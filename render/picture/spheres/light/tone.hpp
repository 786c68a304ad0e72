// From linear light to 8-bit sRGB (IEC 61966-2-1).
#pragma once

#include <array>
#include <cstdint>

namespace grainreel {

// A table over 4096 steps of linear light, each at most 0.8 of a byte's step wide.
class ToneTable {
  public:
    static const ToneTable& get();
    std::uint32_t byte(float linear) const { return bytes_[static_cast<std::size_t>(step(linear))]; }
    // Opaque pixels, `count` of them.
    void pixels(const float* red, const float* green, const float* blue, int count, std::uint32_t* out) const;

  private:
    static constexpr int kSteps = 4096;
    ToneTable();
    static int step(float linear) {
        const float positive = linear < 0 ? 0 : linear, clamped = positive > 1 ? 1 : positive;
        return static_cast<int>(clamped * (kSteps - 1) + 0.5f);
    }
    std::array<std::uint8_t, kSteps> bytes_{};
};

}  // namespace grainreel
