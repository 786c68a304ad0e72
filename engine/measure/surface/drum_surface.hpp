// The free surface of a bed in a drum that turns: its dynamic angle of repose.
//
// The bed is seen along the axis. The angle is that of the least-squares line through the middle third of its
// surface against the horizontal, because away from the walls the surface is straight as long as the bed
// rolls or cascades (Yamane, Nakagawa, Altobelli, Tanaka and Tsuji 1998, Phys. Fluids 10, 1419; Orpe and
// Khakhar 2001, Phys. Rev. E 64, 031302). The surface is that of surface.hpp, so grains in flight do not
// count.
#pragma once

#include <numbers>
#include <optional>
#include <span>

#include "engine/base/vector.hpp"
#include "engine/measure/measures.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/surface/surface.hpp"
#include "engine/measure/walls/wall_bodies.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/motion.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

// Three perpendicular unit vectors: along the axis, across it to the side where the drum carries the bed up,
// and upwards.
struct DrumAxes {
    Vec3 along, across, up;
};
// Empty if the axis stands (within 30 degrees of gravity) or there is no gravity.
std::optional<DrumAxes> drum_axes(const BodyTurn& turn, const Vec3& gravity);

// The angle (rad) is above 0 if the bed is highest on the side where the drum carries it up. `diameter` (m)
// is the mean of the grains. NaN with fewer than 20 grains, or if the middle third has fewer than three bins.
// Bins are about two diameters wide.
double angle_of_repose(std::span<const Place> grains, const DrumAxes& axes, double diameter);

// The Froude number w^2 R / g. Below 1e-4 a bed slips or slumps, up to about 0.1 it rolls and cascades, above
// that it cataracts, and at 1 it goes round with the drum (Mellmann 2001, Powder Technol. 118, 251).
double froude_number(double rate, double radius, double gravity);

}  // namespace grainreel

// Observer of a drum, or of another body that turns the grains: its angle of turn, and the bed's surface in
// it.

namespace grainreel::observers {

class Drum final : public Observer {
  public:
    static constexpr const char* instrument = "drum";

    static std::vector<ColumnGroup> columns(const Scene&) {
        return {
            {{{"revolutions", "revolutions"}},
             "1",
             "of what turns since it began: of the container, or of the mesh that is the container, or of "
             "the "
             "first mesh that turns; NaN without one. Whatever else is measured can be drawn against it"},
            {{{"repose_angle_degree", "dynamic angle of repose", Dimension::degrees}},
             "degrees",
             "of the bed's surface against the horizontal, seen along the axis: of the line of least squares "
             "through the middle third of it, above 0 where the drum carries the bed up (Yamane et al. "
             "1998); "
             "NaN where the axis stands"},
            {{{"froude_number", "Froude number"}},
             "1",
             "square of the rate times the drum's radius over gravity, now; below 1e-4 the bed slumps, then "
             "it "
             "rolls and cascades, from about 0.1 on it cataracts, and at 1 it goes round with the drum "
             "(Mellmann 2001)"}};
    }
    Drum(const Scene& scene, const Plan&) : drum_(turning_body(scene)), diameter_(mean_diameter(scene)) {}

    void look(const ObservedState& m, std::vector<double>& row) override {
        if (!drum_) return add_no_values(row, 3);
        const BodyTurn& turn = drum_->turn;
        const auto axes = drum_axes(turn, m.gravity);
        const double angle = axes ? angle_of_repose(m.grains.place, *axes, diameter_) : kNoValue;
        row.insert(row.end(), {std::abs(turn.angle_at(m.pose.time)) / (2 * std::numbers::pi),
                               angle * 180 / std::numbers::pi,
                               froude_number(turn.rate_at(m.pose.time), drum_->radius, m.gravity.norm())});
    }

  private:
    const std::optional<TurningBody> drum_;
    const double diameter_;  // m
};

}  // namespace grainreel::observers
