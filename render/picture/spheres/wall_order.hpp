// Finds where walls and grains hide each other, pixel by pixel.
//
// Walls are painted as two flat layers, one behind all grains and one in front of them. This is right while
// every grain is inside. Where a grain reaches through a wall or lies on its other side, WallOrder finds
// which shares of a pixel have to be taken away from the grains and from the layer in front of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/team.hpp"
#include "engine/base/vector.hpp"
#include "render/picture/spheres/sphere_kernels.hpp"
#include "render/picture/spheres/visibility.hpp"

namespace grainreel {

struct WallFace {
    std::vector<Vec3> corners;  // m: corners of a flat convex piece, in order around it
    double opacity;             // 1 for a solid one
    bool before;                // whether it is in the layer in front of the grains
    // For WallLight, as in WallSide::Face:
    Vec3 inward{0, 0, 0};
    double taken = 0;
    int wall = 0, container = 0;
    bool operator==(const WallFace&) const = default;
};

// A pixel in which the two layers are not right.
struct WallPixel {
    int x, y;
    float hidden;  // share of the visible grains that walls hide
    float bared;   // share of the walls in front of the grains that grains hide
};

class WallOrder {
  public:
    // faces: in view coordinates. The result does not depend on the team's size.
    void update(const Sight& sight, const Cut& cut, const DrawnGrains& grains,
                const std::vector<WallFace>& faces, const Visibility& visibility, Team& team);
    // Pixels in order from the top left on.
    const std::vector<WallPixel>& pixels() const { return pixels_; }

  private:
    struct Plane {  // normal . p = distance
        Vec3 normal;
        double distance;
        double height(const Vec3& p) const { return normal.dot(p) - distance; }
    };
    // A face whose normal points towards the eye.
    struct Plate {
        Plane plane;
        std::vector<Plane> borders;  // through an edge and upright on the face; inside is positive
        std::vector<Plane> sides;    // through an edge and along lines of sight; inside is positive
        double opacity;
        bool before;

        // Whether a part of a grain may be on the wrong side: nearer to the eye than a face of the layer in
        // front of the grains, or farther than a face of the layer behind them.
        bool disorders(const Vec3& centre, double radius) const;
        // A sphere around the part of a grain that is on the wrong side.
        ViewSphere wrong_part(const Vec3& centre, double radius) const;
        // z of the place where the face meets the line of sight to a point (slopes, or m for an orthographic
        // camera), or < 0.
        double meet(double x, double y, bool orthographic) const;
    };
    struct Finding {
        std::vector<std::size_t> pixels;
        std::vector<bool> active;  // for each plate: whether some grain is on its wrong side
    };

    void prepare(const Sight& sight, const std::vector<WallFace>& faces);
    void find_pixels(const Sight& sight, const std::vector<ViewSphere>& spheres, const Visibility& visibility,
                     Team& team);
    void note_grain(std::uint32_t grain, const PixelBox& box, const Visibility& visibility,
                    Finding& finding) const;
    void judge_block(const Sight& sight, const EdgeBlock& block, WallPixel* pixels, int count) const;

    std::vector<Plate> plates_;
    std::vector<Finding> findings_;  // one for each thread
    std::vector<WallPixel> pixels_;
};

}  // namespace grainreel
