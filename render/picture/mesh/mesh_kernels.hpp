// Triangles into rows of pixels: the hot loops of drawing meshes, compiled for each instruction set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace grainreel {

// Places in a pixel, from its middle, at which what is solid is asked for: a square turned by 27 degrees, so
// that edges along rows and columns have five steps.
constexpr int kMeshSamples = 4;
constexpr float kSampleX[kMeshSamples] = {-0.125f, 0.375f, -0.375f, 0.125f};
constexpr float kSampleY[kMeshSamples] = {-0.375f, -0.125f, 0.125f, 0.375f};

// How near a point is: 1/z in perspective, -z with an orthographic camera. Both are linear in the picture.
constexpr float kNowhereNear = -std::numeric_limits<float>::infinity();

// value = at + x (px - px0) + y (py - py0), between low and high.
struct ScreenPlane {
    float at = 0, x = 0, y = 0;
    float low = 0, high = 0;
};

// A triangle in pixels from the top left of the port. An edge is the same to the bit in both triangles that
// share it, and points on it belong to one of them.
struct ScreenTriangle {
    struct Edge {
        float x, y, a, b;  // inside where a (px - x) + b (py - y) > least
        float least;
    };
    Edge edge[3];
    float x = 0, y = 0;  // of one corner, from which the planes count
    ScreenPlane near, shade;
    float colour[3], brighter[3];        // 0 to 255, at shade 0, and what comes on top at shade 1
    float tint = 0;                      // of glass: thickness, in panes seen straight
    std::uint32_t number = 0;            // of the triangle, for who asks; from 1 on
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // pixels that it may touch; high ends excluded
};

// Rows of a band, `stride` numbers each; pixels up to 15 past a row's end may be read and written.
struct MeshRows {
    float* near[kMeshSamples];            // at the samples, of what is nearest so far
    std::uint32_t* colour[kMeshSamples];  // opaque
    float* near_middle;                   // in the middle of the pixel
    std::uint32_t* number;                // of what is seen there
    std::size_t stride;
    int first_row;  // of the picture
};

struct GlassRows {
    const float* away;  // m, z of what is seen behind
    float* thickness;   // of all glass before that
    std::size_t away_stride, stride;
    int first_row;
    bool orthographic;
};

struct MeshKernels {
    // Rows y0 to y1 (excluded) of the picture, which lie in the band.
    void (*solid)(const ScreenTriangle&, const MeshRows&, int y0, int y1);
    void (*glass)(const ScreenTriangle&, const GlassRows&, int y0, int y1);
    // The mean of the samples of a row: colours multiplied by their alpha; z of the pixel's middle, infinite
    // where there is nothing. Bits are set, 64 to a word, where samples differ: not all are covered, or they
    // lie apart by more than `apart` of the nearest's depth (orthographic: m).
    void (*gather)(const MeshRows&, int row, int x0, int x1, bool orthographic, float apart,
                   std::uint32_t* colours, float* away, std::uint64_t* differ);
    // Glass of one colour (0 to 255 each) over a row of pixels.
    void (*tint)(const float* thickness, const float* colour, int count, std::uint32_t* pixels);
};
const MeshKernels& mesh_kernels();

// Alpha of glass so thick, in panes: 0.05 for one, never more than 0.25.
constexpr float kMostTint = 0.25f, kPaneShare = 0.25f;

}  // namespace grainreel
