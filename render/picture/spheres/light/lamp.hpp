// The lamp that grains and the legend's spheres share, and the conversion from linear light to the bytes of a
// picture.
#pragma once

#include <array>
#include <cstdint>

namespace grainreel {

// A key light over the viewer's left shoulder, sky and ground around, and a slight shine. Linear light;
// directions in view coordinates (x right, y up, z away).
struct Lamp {
    float to_key[3] = {-0.4793f, 0.6590f, -0.5792f};  // unit, towards the key light
    float key = 0.78f;     // share of the albedo where the key light falls straight on
    float spread = 0.05f;  // tangent of half the angle of the key light: how soft shadows are
    float sky = 0.62f;     // ambient light from above
    float ground = 0.34f;  // ambient light from below
    float even = 0;        // share of the albedo that is the same everywhere
    float up[3] = {0, 1, 0};
    float rim = 0.72f;        // share of the light left at the silhouette, which keeps grains apart
    float rim_width = 0.45f;  // cosine between normal and line of sight at which the rim ends
    float shine = 0.12f;      // strength of the highlight
    float tone = 0.40f;       // share of the colour on the darker half of a two-tone grain
    float cap = 0.80f;        // share of the albedo that a cut face shows
    bool occlusion = true, shadows = true;
};

// Converts linear light to 8-bit sRGB (IEC 61966-2-1) by a table of 4096 steps. Each step is at most 0.8 of a
// byte's step wide.
class ToneTable {
  public:
    static const ToneTable& get();
    std::uint32_t byte(float linear) const { return bytes_[step(linear)]; }
    // Makes `count` opaque pixels.
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
