// Arrows and streamlines of the grains' mean velocity.
#pragma once

#include <optional>

#include "engine/frame.hpp"
#include "render/picture/base/canvas.hpp"
#include "render/picture/base/palette.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/grains/velocity_field.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

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
