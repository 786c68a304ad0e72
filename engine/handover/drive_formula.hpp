// The drive as variables of LAMMPS' input language, which LIGGGHTS shares: `variable NAME equal EXPRESSION`.
// They are the formulas of WallMotion (engine/state/wall_motion.hpp), with ramp, stages, changes and taps.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct PeerVariable {
    std::string name, expression;
};

// In order: each uses those above it alone. v_t is the time of the drive (s), which the deck defines first.
// The last three are `shift` (m), `speed` (m/s) and `ride` (m/s2, minus the acceleration), along the drive's
// direction. Every expression is finite at all times, and shorter than 1000 characters.
struct DriveFormula {
    std::vector<PeerVariable> variables;
    Vec3 direction{0, 0, 1};  // unit
    bool empty() const { return variables.empty(); }
};

// Empty without a drive, or with one that never moves.
DriveFormula drive_formula(const Drive& drive);

// `v_t` as seconds since the drive started, 0 before it. shift: steps that the engine counts before that.
PeerVariable time_variable(std::int64_t shift);

// The angle (rad) and rate (rad/s) of a turn as expressions of v_t.
struct TurnFormula {
    std::string angle, rate;
    bool empty() const { return angle.empty(); }
};
TurnFormula turn_formula(const BodyTurn& turn);

// A number with all its digits; one below zero in brackets, since the language knows no a*-b.
std::string peer_number(double value);

}  // namespace grainreel
