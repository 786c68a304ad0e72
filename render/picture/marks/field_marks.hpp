// Marks that show coarse-grained fields of the grains (engine/measure/fields): a coloured layer of a
// quantity, and arrows and streamlines of the mean velocity.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/measure/fields/footprint.hpp"
#include "render/picture/base/canvas.hpp"
#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/picture/grains/velocity_field.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// A quantity of the grains as a coloured layer in front of them: its mean over the depth, weighted by mass.
// The layer stands in the container's front face.
class FieldLayer {
  public:
    explicit FieldLayer(const FilmedScene& scene);

    // See Renderer::start_from().
    void start_from(const State& frame) { quantities_.start_from(frame); }
    void draw(const View& view, const Shot& frame, Shapes& on);
    const ClippedCount& clipped() const { return clipped_; }  // counts cells

  private:
    void gather(const Shot& frame);

    const FilmedScene& scene_;
    const FieldGrid grid_;
    const std::vector<double> shares_;  // the share of each cell that is inside the container
    Footprint footprint_;
    Quantities quantities_;
    ColourScale scale_;
    ClippedCount clipped_;
    // For each cell: solid fraction, density (kg/m3), and density times the mean of the quantity.
    std::vector<double> solid_, mass_, sum_;
};

// The velocity (m/s) at a place (y, z) in m; none where too few grains are near.
using PlaneVelocity = std::function<std::optional<Eigen::Vector2d>(const Eigen::Vector2d&)>;

struct StreamPoint {
    Eigen::Vector2d at;  // m
    double speed;        // m/s
};

// A piece of a streamline through `seed`, up to `reach` (m) on either side of it; it is shorter where the
// field ends or stands still, and empty where the seed has no velocity. Its points are `step` (m) apart,
// found by the fourth order method of Runge and Kutta in arc length.
std::vector<StreamPoint> streamline(const PlaneVelocity& velocity, const Eigen::Vector2d& seed, double reach,
                                    double step);

// m: the side of an arrow's cell.
double arrow_cell(const FilmedScene& scene);
// m: the length of an arrow for each m/s.
double arrow_scale(const FilmedScene& scene);
// Pixels: the full width of a streamline, which it has where the flow is as fast as the film's scale or
// faster.
double widest_streamline(int picture_height);

// Arrows and streamlines of the mean velocity.
class FlowMarks {
  public:
    FlowMarks(const FilmedScene& scene, const Palette& palette);
    void draw(const View& view, const Shot& frame, Shapes& on);

  private:
    void draw_arrows(const View& view, const State& frame, Shapes& on) const;
    void draw_streamlines(const View& view, const State& frame, Shapes& on) const;
    void draw_streamline(const View& view, const State& frame, const Eigen::Vector2d& seed, Shapes& on) const;

    const FilmedScene& scene_;
    const Palette palette_;
    const double pen_;  // pixels
    std::optional<VelocityField> arrows_, streamlines_;
};

}  // namespace grainreel
