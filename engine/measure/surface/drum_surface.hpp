// The free surface of a bed in a drum that turns: its dynamic angle of repose.
//
// The bed is looked at along the axis. The line of least squares through the middle third of its surface has
// the angle against the horizontal: away from the walls the surface is straight as long as the bed rolls or
// cascades (Yamane, Nakagawa, Altobelli, Tanaka and Tsuji 1998, Phys. Fluids 10, 1419; Orpe and Khakhar 2001,
// Phys. Rev. E 64, 031302). The surface is that of surface.hpp, so grains in flight have no say.
#pragma once

#include <optional>
#include <span>

#include "engine/base/vector.hpp"
#include "engine/measure/surface/surface.hpp"
#include "engine/scene/motion/turn.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

// Three unit directions at right angles: along the axis, across it to the side where the drum carries the bed
// up, and upwards.
struct DrumAxes {
    Vec3 along, across, up;
};
// Empty where the axis stands (within 30 degrees of gravity) or nothing pulls.
std::optional<DrumAxes> drum_axes(const BodyTurn& turn, const Vec3& gravity);

// rad, above 0 where the bed is highest on the side where the drum carries it up. diameter: m, mean of the
// grains. NaN with fewer than 20 grains, or where the middle third has fewer than three bins, which are about
// two diameters wide.
double angle_of_repose(std::span<const Place> grains, const DrumAxes& axes, double diameter);

// w^2 R / g. Below 1e-4 a bed slips or slumps, it rolls and cascades up to about 0.1, then cataracts, and at
// 1 it goes round with the drum (Mellmann 2001, Powder Technol. 118, 251).
double froude_number(double rate, double radius, double gravity);

}  // namespace grainreel
