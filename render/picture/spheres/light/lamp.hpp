// The light that grains and the legend's spheres share: a key light over the viewer's left shoulder, sky and
// ground around, a slight shine. Linear light; directions in view coordinates (x right, y up, z away).
#pragma once

namespace grainreel {

struct Lamp {
    float to_key[3] = {-0.4793f, 0.6590f, -0.5792f};  // unit, towards the key light
    float key = 0.78f;                                // of the albedo, where it falls straight
    float spread = 0.05f;  // tangent of half the angle that it subtends: how soft shadows are
    float sky = 0.62f;     // ambient from above ...
    float ground = 0.34f;  // ... and from below
    float even = 0;        // of the albedo everywhere: nothing hides or turns away from it
    float up[3] = {0, 1, 0};
    float rim = 0.72f;        // what is left at the silhouette, so that grains stay separable
    float rim_width = 0.45f;  // cosine between normal and line of sight where that ends
    float shine = 0.12f;      // of the highlight
    float tone = 0.40f;       // of the darker half of a two-tone grain
    float cap = 0.80f;        // of what a cut face shows
    bool occlusion = true, shadows = true;
};

}  // namespace grainreel
