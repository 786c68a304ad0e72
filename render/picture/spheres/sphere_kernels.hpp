// The hot loops of drawing spheres and other shapes of grains, and their arguments: spheres, lines of sight
// and cuts. View coordinates (m) have x to the right, y up and z away from the eye; pixels count from the top
// left of the port. The loops work on many pixels at once and are compiled for each instruction set; they are
// written in the files
// *-inl.hpp of this folder.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "render/picture/spheres/light/lamp.hpp"

namespace grainreel {

struct ViewSphere {
    float x = 0, y = 0, z = 0, radius = 0;
};

// A grain that is no sphere: (|x|^around + |y|^around)^(along/around) + |z|^along = 1, where x, y and z count
// along its own axes in its half lengths. With both powers 2 it is an ellipsoid, else a superquadric (Barr
// 1981); powers are at least 2.
struct ViewShape {
    float to_unit[3][3];  // 1/m: takes a vector from the centre, in view coordinates, to its own x, y and z
    float along = 2, around = 2;
};

// Finds the line of sight of a pixel. slope_x() and slope_y() are x and y of the line at z = 1 (perspective),
// or at any z (orthographic, m).
struct Sight {
    bool orthographic = false;
    float focal = 1;  // pixels a unit of slope
    float centre_x = 0, centre_y = 0;
    float slope_x(float pixel) const { return (pixel - centre_x) / focal; }
    float slope_y(float pixel) const { return (centre_y - pixel) / focal; }
};

// The half-spaces in which grains are kept, normal . p >= d, bounded by up to two planes; a slab has two.
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

// The rows of the picture that spheres are drawn into. Up to 15 pixels past the end of a row may be read and
// written.
struct DepthRows {
    const float* slope_x;  // slopes x of the columns' middles
    float* depth;          // z of the nearest sphere so far
    std::uint32_t* seen;   // number of that sphere
    std::size_t stride;
    int first_row;  // row of the picture that `depth` and `seen` begin with
};

// Sixteen pixels on edges, and the grains that may be seen there.
constexpr int kPointBlock = 16, kCandidates = 4;
// Each pixel has eight points, at the places of Direct3D's standard multisample pattern, in sixteenths of a
// pixel.
constexpr int kPoints = 8;
constexpr float kPointX[kPoints] = {1, -1, 5, -3, -5, -7, 3, 7};
constexpr float kPointY[kPoints] = {-3, 3, 1, -5, 5, -1, 7, -7};
constexpr float kNoGrain = 1e30f;  // m: depth where no grain is met
struct alignas(64) EdgeBlock {
    float x[kPointBlock], y[kPointBlock];  // pixels, of the pixel's middle
    ViewSphere candidate[kCandidates][kPointBlock];
    // Results: the share of the pixel that shows each candidate, and the mean place of the points that show
    // it, from the middle.
    float share[kCandidates][kPointBlock];
    float mean_x[kCandidates][kPointBlock], mean_y[kCandidates][kPointBlock];
    float nearest[kPoints][kPointBlock];  // m, depth of the grain seen at a point
    int candidates = 0;  // the largest number that any of the pixels has; unused ones have radius < 0
    const ViewShape* shape[kCandidates][kPointBlock];  // of the candidates, for settle_shapes
};

// A grain near another one. x, y and z count from the centre of the other.
struct NearGrain {
    float x, y, z, radius;
    float inverse_radius, square;  // 1/m, m2
    float weight;                  // how much light it takes; 0 at the end of its reach
    float unused = 0;
};

struct NeighbourSpan {
    const NearGrain* first = nullptr;
    int count = 0;
};

struct LitGrain {
    ViewSphere sphere;
    float albedo[3];                   // linear
    float pole[3] = {0, 0, 0};         // unit axis of a two-tone grain; 0 for plain ones
    const ViewShape* shape = nullptr;  // null: the grain is a sphere
    NeighbourSpan occluders, casters;
};

// Any number of points of one grain. Each array has room for a multiple of 16.
struct LitPoints {
    const float *x, *y;         // pixels
    float *red, *green, *blue;  // results: linear light
    int count;
};

// Walls as they meet in a corner, where they take light from each other: inner planes in view coordinates.
struct CornerPlane {
    float x, y, z, d;  // unit normal towards the grains, m from the origin of the points
    float wall, container;
    float taken;  // how much of it is there, 0 to 1, while a wall turns from glass to solid
};

// A row of pixels that show walls. Results are the shares of their colour that are left, 0 to 1.
constexpr int kWallRow = 16;
struct WallRow {
    float x, y;                             // pixels, the middle of the first one
    alignas(64) float away[kWallRow];       // m, z
    alignas(64) float normal[3][kWallRow];  // unit, towards the grains
    alignas(64) float taken[kWallRow];      // how much of the light may be taken; 0: no wall is seen here
    alignas(64) float tone[kWallRow];       // what is left of the colour where nothing is in the way
    alignas(64) float wall[kWallRow], container[kWallRow];
    alignas(64) float share[kWallRow];  // results
};
// What takes light from some rows. Places count from the origin, a point near the rows in view coordinates.
struct WallShade {
    float origin[3];
    NeighbourSpan occluders, casters;
    const CornerPlane* corner;
    int corners;
    float corner_reach;  // m, how high walls count as
};

struct SphereKernels {
    void (*draw)(const Sight&, const Cut&, const DepthRows&, const ViewSphere&, const PixelBox&,
                 std::uint32_t number);
    void (*draw_shape)(const Sight&, const Cut&, const DepthRows&, const ViewSphere& around, const ViewShape&,
                       const PixelBox&, std::uint32_t number);
    // The largest depth in a box.
    float (*farthest)(const DepthRows&, const PixelBox&);
    // These two write a bit for each of `count` pixels of a row, 64 to a word and the first in the lowest
    // bit. mark_changes sets the bit where a pixel differs from the one before it, and mark_edges sets it
    // where a pixel differs from one of its four neighbours. Pixels past the row's ends are read, see
    // Visibility.
    void (*mark_changes)(const std::uint32_t* row, int count, std::uint64_t* bits);
    void (*mark_edges)(const std::uint32_t* row, const std::uint32_t* above, const std::uint32_t* below,
                       int count, std::uint64_t* bits);
    // Computes the results of the block.
    void (*settle)(const Sight&, const Cut&, EdgeBlock&);
    void (*settle_shapes)(const Sight&, const Cut&, EdgeBlock&);
    void (*light)(const Sight&, const Cut&, const Lamp&, const LitGrain&, const LitPoints&);
    void (*light_wall)(const Sight&, const Lamp&, const WallShade&, WallRow&);
};
const SphereKernels& sphere_kernels();

}  // namespace grainreel
