// A quantity of the grains as a coloured layer before them: its mean over the depth by coarse-graining,
// weighted by mass (engine/measure/fields). The layer stands in the container's front face.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/frame.hpp"
#include "engine/measure/fields/footprint.hpp"
#include "render/picture/base/canvas.hpp"
#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/palette.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/grains/grain_colours.hpp"
#include "render/picture/grains/velocity_field.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class FieldLayer {
  public:
    explicit FieldLayer(const FilmedScene& scene);

    // See Renderer.
    void start_from(const Frame& frame) { quantities_.start_from(frame); }
    void draw(const View& view, const Frame& frame, Shapes& on);
    const ClippedCount& clipped() const { return clipped_; }  // cells

  private:
    void gather(const Frame& frame);

    const FilmedScene& scene_;
    const FieldGrid grid_;
    const std::vector<double> shares_;  // of each cell that are inside the container
    Footprint footprint_;
    Quantities quantities_;
    ColourScale scale_;
    ClippedCount clipped_;
    std::vector<double> solid_, mass_, sum_;  // in each cell: solid fraction, kg/m3, and that times the mean
};

// A piece of a streamline of a plane velocity field.

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
