// The light that grains and the legend's spheres share: a key light over the viewer's left shoulder, sky and
// ground around, a slight shine. Linear light; directions in view coordinates (x right, y up, z away).
#pragma once

namespace grainreel::light {

inline constexpr double key_direction[3] = {-0.48, 0.66, -0.58};  // towards the light, nearly unit
inline constexpr double key = 0.60;        // of the albedo, where the key light falls straight
inline constexpr double sky = 0.50;        // ambient from above ...
inline constexpr double ground = 0.26;     // ... and from below
inline constexpr double rim = 0.50;        // what is left at the silhouette, so that grains stay separable
inline constexpr double rim_width = 0.50;  // cosine between normal and line of sight where that ends
inline constexpr double shine = 0.16;      // of the highlight
inline constexpr double shine_power = 40;
inline constexpr double crowding = 1.25;  // darkening per unit of solid fraction around

}  // namespace grainreel::light
