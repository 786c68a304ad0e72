// Spheres, lines of sight and cuts as the kernels take them, in view coordinates (m): x right, y up, z away
// from the eye. Pixels count from the top left of the port.
#pragma once

#include <algorithm>

namespace grainreel {

struct ViewSphere {
    float x = 0, y = 0, z = 0, radius = 0;
};

// From a pixel to its line of sight: x and y of the line at z = 1 (perspective), or at any z (orthographic,
// m).
struct Sight {
    bool orthographic = false;
    float focal = 1;  // pixels a unit of slope
    float centre_x = 0, centre_y = 0;
    float slope_x(float pixel) const { return (pixel - centre_x) / focal; }
    float slope_y(float pixel) const { return (centre_y - pixel) / focal; }
};

// What is kept of the grains: the half-spaces x . p >= d of up to two planes; a slab has two.
struct Cut {
    struct Plane {
        float x = 0, y = 0, z = 0, d = 0;  // unit normal, m
        float height(const ViewSphere& s) const { return x * s.x + y * s.y + z * s.z - d; }
    };
    int planes = 0;
    Plane plane[2];

    // The share of a sphere's diameter that is kept: 1 for all of it, 0 for a sphere that is cut away.
    float share(const ViewSphere& s) const {
        float kept = 1;
        for (int i = 0; i < planes; ++i)
            kept = std::min(kept, std::clamp(0.5f + 0.5f * plane[i].height(s) / s.radius, 0.0f, 1.0f));
        return kept;
    }
};

// A box of pixels; high ends are excluded.
struct PixelBox {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool empty() const { return x0 >= x1 || y0 >= y1; }
};

}  // namespace grainreel
