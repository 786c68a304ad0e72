// How LAMMPS' own formulas must be told a dashpot of ours. engine/plan/damping.hpp solves for the
// restitution.
#pragma once

#include <optional>

namespace grainreel {

// LAMMPS' `damping tsuji` takes a restitution e and makes the damping
//   alpha = 1.2728 - 4.2783 e + 11.087 e^2 - 22.348 e^3 + 27.467 e^4 - 18.022 e^5 + 4.8218 e^6
// of it (manual, pair_style granular), for N_d = alpha sqrt(m_eff k a) v. That is our Hertz dashpot with d =
// alpha. The e that gives this alpha; none where it would lie outside [-0.5, 1].
std::optional<double> tsuji_restitution(double alpha);
double tsuji_damping(double restitution);  // that polynomial

}  // namespace grainreel
