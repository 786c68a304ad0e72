// A piece of a streamline of a plane velocity field.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/frame.hpp"
#include "render/picture/base/canvas.hpp"
#include "render/picture/base/palette.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/grains/velocity_field.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// m/s at a place (y, z), m; none where there is no flow to speak of.
using PlaneVelocity = std::function<std::optional<Eigen::Vector2d>(const Eigen::Vector2d&)>;

struct StreamPoint {
    Eigen::Vector2d at;  // m
    double speed;        // m/s
};

// Through `seed`, along the flow, up to `reach` (m) on either side of it; shorter where the field ends or
// stands still. Of points `step` (m) apart, by the fourth order method of Runge and Kutta in arc length.
// Empty where the seed has no velocity.
std::vector<StreamPoint> streamline(const PlaneVelocity& velocity, const Eigen::Vector2d& seed, double reach,
                                    double step);

// Arrows and streamlines of the grains' mean velocity.

// m: side of an arrow's cell.
double arrow_cell(const FilmedScene& scene);
// m an arrow is long for each m/s.
double arrow_scale(const FilmedScene& scene);
// Pixels, of a line where the flow has the speed of full width or more.
double widest_streamline(int picture_height);

class FlowMarks {
  public:
    FlowMarks(const FilmedScene& scene, const Palette& palette);
    void draw(const View& view, const Frame& frame, Shapes& on);

  private:
    void draw_arrows(const View& view, const Frame& frame, Shapes& on) const;
    void draw_streamlines(const View& view, const Frame& frame, Shapes& on) const;
    void draw_streamline(const View& view, const Frame& frame, const Eigen::Vector2d& seed, Shapes& on) const;

    const FilmedScene& scene_;
    const Palette palette_;
    const double pen_;  // pixels
    std::optional<VelocityField> arrows_, streamlines_;
};

}  // namespace grainreel
