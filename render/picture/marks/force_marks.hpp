// Arrows over the grains: of forces at points of a body, and of the mean force of the grains on each wall.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/state/contact.hpp"
#include "engine/state/container_faces.hpp"
#include "render/picture/base/canvas.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/base/view.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct ArrowStyle {
    Colour colour, border;
    double width;  // pixels, of the shaft
    double pen;    // pixels, of the border
};

// Draws an arrow on a border of the background's colour, so that it can be seen on any grain.
inline void draw_arrow(Shapes& on, const Pixel& tail, const Pixel& tip, const ArrowStyle& style) {
    const double length = (tip - tail).norm();
    if (length < 1) return;
    const Pixel ahead = (tip - tail) / length, aside(-ahead.y(), ahead.x());
    const double head = std::min(3.6 * style.width, 0.5 * length);
    const Pixel neck = tip - head * ahead;
    const std::vector<Pixel> corners{tip, neck + 0.45 * head * aside, neck - 0.45 * head * aside};
    on.line(corners, true, 2 * style.pen, {style.border, 1});
    on.line({tail, neck}, false, style.width + 2 * style.pen, {style.border, 1});
    on.line({tail, neck}, false, style.width, {style.colour, 1});
    on.polygon(corners, {style.colour, 1});
    on.line(corners, true, 0.5 * style.pen, {style.colour, 1});
}

// Pixels: the length of the arrow of the strongest force.
double longest_force_arrow(const View& view);

// The arrow of a force in the picture. Lengths are proportional to the forces, but arrows of weak forces stay
// long enough to be seen. Where a grain is so small that heads would hide it and each other, arrows are moved
// away from its centre. The arrow of a force along the line of sight has a length near 0.
struct ForceArrow {
    Pixel tail, tip;
    double share;     // the force divided by the strongest force
    bool at_eye;      // the force points towards the eye
    double in_space;  // pixels: the arrow's length if it lay across the line of sight
};
std::vector<ForceArrow> force_arrows(const View& view, const std::vector<PointForce>& forces, double pen);

// Draws forces on a body, each as an arrow at the point where it acts. A force along the line of sight is
// drawn as a circle, with a point in it if the force is towards the eye and a cross if it is away from the
// eye. pen: pixels, of the border.
void draw_point_forces(const View& view, const std::vector<PointForce>& forces, const Palette& palette,
                       double pen, Shapes& on);

// m: the length of a wall force's arrow for each N.
double wall_force_scale(const FilmedScene& scene);

// The point where the line of action of a force crosses a plane, or where it leaves a cylinder whose axis is
// along z; none where the force runs along the wall within 3 degrees, or passes the cylinder by. moment: N m,
// about the origin.
std::optional<Vec3> point_of_action(const Face& wall, const Vec3& force, const Vec3& moment);

// Arrows of the mean force of the grains on each wall, from the last row of measures (instrument `walls`). An
// arrow's tip is where the force acts on the wall.
class WallForceMarks {
  public:
    WallForceMarks(const FilmedScene& scene, const Palette& palette);
    void draw(const View& view, const Shot& frame, Shapes& on) const;

  private:
    struct Wall {
        Face face;
        std::string name;  // the wall's name in the names of columns
    };
    void draw_wall(const Wall& wall, const View& view, const Shot& frame, Shapes& on) const;

    const FilmedScene& scene_;
    const Palette palette_;
    const double pen_;  // pixels
    std::vector<Wall> walls_;
};

}  // namespace grainreel
