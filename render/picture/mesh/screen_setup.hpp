// Turns corners in view coordinates into triangles and lines in pixels, and cuts them off where nothing is
// drawn. Hot code.
#pragma once

#include <array>

#include "engine/base/vector.hpp"
#include "render/picture/mesh/mesh_kernels.hpp"
#include "render/picture/spheres/sphere_kernels.hpp"

namespace grainreel {

// A corner in view coordinates (m), how brightly it is lit, 0 to 1, and its own colour, 0 to 255.
struct LitCorner {
    Eigen::Vector3f at;
    float shade = 0;
    Eigen::Vector3f own = Eigen::Vector3f::Zero();
};

// The part of space that is drawn: what lies in all these half-spaces normal . p >= distance. In perspective
// the first half-space keeps what is in front of the eye; the others belong to a cut.
struct DrawnSpace {
    struct Half {
        Eigen::Vector3f normal;
        float distance;  // m
        float height(const Eigen::Vector3f& p) const { return normal.dot(p) - distance; }
    };
    int count = 0;
    Half half[3];
    static DrawnSpace of(const Sight& sight, const Cut& cut, float nearest);
    bool holds(const Eigen::Vector3f& p) const {
        for (int i = 0; i < count; ++i)
            if (half[i].height(p) < 0) return false;
        return true;
    }
};

// A convex piece of a plane: a triangle that at most three planes have cut.
struct Piece {
    std::array<LitCorner, 8> corner;
    int count = 0;
};
// Keeps what lies in one half-space. section: if not null, gets the two points where the piece crosses the
// border of the half-space. Returns whether there are two such points. A point on an edge is the same, to the
// bit, for both its triangles.
bool clip(const DrawnSpace::Half& half, Piece& piece, std::array<Eigen::Vector3f, 2>* section);

struct PortSize {
    int width, height;
};

// Fills in all members of a triangle except `colour`, `brighter` and number; `blended` is given. Returns
// false where no part of the triangle can be seen.
bool set_up(const Sight& sight, const PortSize& port, const LitCorner& a, const LitCorner& b,
            const LitCorner& c, ScreenTriangle& triangle);

// Pixels from the top left, and how near the point is (see kNowhereNear).
Eigen::Vector3f on_screen(const Sight& sight, const Eigen::Vector3f& at);

// A straight line that is seen where nothing solid hides it.
struct ScreenLine {
    Eigen::Vector3f from, to;            // on the screen
    Eigen::Vector3f view_from, view_to;  // m
    float half_width;                    // pixels
    float strength;                      // 0 to 1
    bool glass;                          // edge of glass alone
};
// Cuts a line off at the borders of the space, except for the border in_border that it lies in (-1: none).
// Returns false where nothing is left.
bool set_up(const Sight& sight, const DrawnSpace& space, Eigen::Vector3f from, Eigen::Vector3f to,
            int in_border, ScreenLine& line);

}  // namespace grainreel
