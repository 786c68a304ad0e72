// Writes the drive as variables of LAMMPS' input language, which LIGGGHTS has too: `variable NAME equal
// EXPRESSION`. The formulas are those of DriveMotion (engine/state/drive_motion.hpp), with ramp, stages,
// changes and taps; both must stay the same.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/scene.hpp"

namespace grainreel {

struct PeerVariable {
    std::string name, expression;
};

// Variables in order: each uses only earlier ones and v_t, the time of the drive (s), which the deck defines
// first. The last three are `shift` (m), `speed` (m/s) and `ride` (m/s2, minus the acceleration) along the
// drive's direction. Every expression is finite at all times and shorter than 1000 characters.
struct DriveFormula {
    std::vector<PeerVariable> variables;
    Vec3 direction{0, 0, 1};  // unit
    bool empty() const { return variables.empty(); }
};

// Empty without a drive, and for a drive that never moves.
DriveFormula drive_formula(const Drive& drive);

// `v_t`: seconds since the drive started, or 0 before. shift: number of steps that the engine counts before
// that.
PeerVariable time_variable(std::int64_t shift);

// The angle (rad) and rate (rad/s) of a turn as expressions of v_t.
struct TurnFormula {
    std::string angle, rate;
    bool empty() const { return angle.empty(); }
};
TurnFormula turn_formula(const BodyTurn& turn);

// A number with all its digits. A negative one is in brackets, because the language does not allow a*-b.
std::string peer_number(double value);

}  // namespace grainreel
