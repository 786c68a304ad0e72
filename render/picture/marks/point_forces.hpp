// Forces on a body, each an arrow at the point where it acts.
#pragma once

#include <vector>

#include "engine/state/point_force.hpp"
#include "render/picture/base/canvas.hpp"
#include "render/picture/base/palette.hpp"
#include "render/picture/base/view.hpp"

namespace grainreel {

// Pixels of the arrow of the strongest force.
double longest_force_arrow(const View& view);

// Where the arrows lie in the picture. Lengths are proportional to the forces, but for weak ones, which stay
// long enough to be seen. Where a grain is so small in the picture that heads would hide it and each other,
// arrows are moved away from its centre. A force along the line of sight has a length near 0.
struct ForceArrow {
    Pixel tail, tip;
    double share;     // of the strongest force
    bool at_eye;      // it points towards the eye
    double in_space;  // pixels, if it lay across the line of sight
};
std::vector<ForceArrow> force_arrows(const View& view, const std::vector<PointForce>& forces, double pen);

// A force along the line of sight is a circle: with a point where it comes towards the eye, with a cross
// where it goes away. pen: pixels, of the border.
void draw_point_forces(const View& view, const std::vector<PointForce>& forces, const Palette& palette,
                       double pen, Shapes& on);

}  // namespace grainreel
