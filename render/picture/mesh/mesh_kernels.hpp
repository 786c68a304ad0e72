// The hot loops of drawing meshes, from triangles to rows of pixels. They are compiled for each instruction
// set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace grainreel {

// The places of a pixel's samples for solid triangles, from the middle of the pixel. They form a square
// turned by 27 degrees, so that an edge along a row or a column covers 0, 1, 2, 3 or 4 samples of a pixel.
constexpr int kMeshSamples = 4;
constexpr float kSampleX[kMeshSamples] = {-0.125f, 0.375f, -0.375f, 0.125f};
constexpr float kSampleY[kMeshSamples] = {-0.375f, -0.125f, 0.125f, 0.375f};

// How near a point is: 1/z in perspective, -z with an orthographic camera. Both are linear in the picture.
constexpr float kNowhereNear = -std::numeric_limits<float>::infinity();

// A value that is linear in the picture, at + x (px - px0) + y (py - py0), and is held between low and high.
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
    float x = 0, y = 0;  // one corner: px0 and py0 of the planes
    ScreenPlane near, shade;
    float colour[3], brighter[3];        // 0 to 255: colour at shade 0, and what shade 1 adds to it
    bool blended = false;                // has colours that go from corner to corner, and not those two
    ScreenPlane own[3];                  // 0 to 255: these colours in full light
    float tint = 0;                      // thickness of glass, in panes seen straight on
    std::uint32_t number = 0;            // number of its plane in MeshProjection, from 1 on
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // pixels that it may touch; high ends excluded
};

// Rows of a band, `stride` numbers each. Up to 15 pixels past the end of a row may be read and written.
struct MeshRows {
    float* near[kMeshSamples];            // the greatest nearness so far, at each sample
    std::uint32_t* colour[kMeshSamples];  // opaque
    float* near_middle;                   // nearness in the middle of the pixel
    std::uint32_t* number;                // the triangle that is seen there (ScreenTriangle::number)
    std::size_t stride;
    int first_row;  // number of the row in the picture
};

struct GlassRows {
    const float* away;  // m, z of what is seen behind the glass
    float* thickness;   // thickness of all glass in front of it, in panes
    std::size_t away_stride, stride;
    int first_row;
    bool orthographic;
};

struct MeshKernels {
    // Draw a triangle in rows y0 to y1 (excluded) of the picture, which lie in the band.
    void (*solid)(const ScreenTriangle&, const MeshRows&, int y0, int y1);
    void (*glass)(const ScreenTriangle&, const GlassRows&, int y0, int y1);
    // Takes the mean of the samples of a row: colours multiplied by alpha, and z of the pixel's middle, which
    // is infinite where there is nothing. Bits, 64 to a word, are set where samples differ. Samples differ
    // where not all are covered, or where their depths differ by more than `apart` times the nearest depth
    // (orthographic: by more than `apart` m).
    void (*gather)(const MeshRows&, int row, int x0, int x1, bool orthographic, float apart,
                   std::uint32_t* colours, float* away, std::uint64_t* differ);
    // Lays glass of one colour (0 to 255 each) over a row of pixels.
    void (*tint)(const float* thickness, const float* colour, int count, std::uint32_t* pixels);
};
const MeshKernels& mesh_kernels();

// A triangle that shows a quantity has this share of its colour where it is turned away from the light.
constexpr float kDarkColour = 0.7f;

// Constants of the alpha of glass as a function of its thickness in panes: 0.05 for one pane, and 0.25 at
// most.
constexpr float kMostTint = 0.25f, kPaneShare = 0.25f;

}  // namespace grainreel
