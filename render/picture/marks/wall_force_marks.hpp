// Arrows of the mean force of the grains on each wall, as the last row of measures has it (instrument
// `walls`). An arrow's tip is where the force acts on the wall.
#pragma once

#include <optional>
#include <vector>

#include "engine/frame.hpp"
#include "engine/state/container_faces.hpp"
#include "render/picture/base/canvas.hpp"
#include "render/picture/base/palette.hpp"
#include "render/picture/base/view.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// m an arrow is long for each N.
double wall_force_scale(const FilmedScene& scene);

// Where the line of action of a force crosses a plane. moment: N m, about the origin. None where the force
// runs along the plane: within 3 degrees.
std::optional<Vec3> point_of_action(const Face& plane, const Vec3& force, const Vec3& moment);

class WallForceMarks {
  public:
    WallForceMarks(const FilmedScene& scene, const Palette& palette);
    void draw(const View& view, const Frame& frame, Shapes& on) const;

  private:
    struct Wall {
        Face face;
        std::string name;  // as columns have it
    };
    void draw_wall(const Wall& wall, const View& view, const Frame& frame, Shapes& on) const;

    const FilmedScene& scene_;
    const Palette palette_;
    const double pen_;  // pixels
    std::vector<Wall> walls_;
};

}  // namespace grainreel
