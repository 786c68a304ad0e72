// How fast this machine steps grains, told in a tenth of a second.
#pragma once

namespace grainreel {

// Grain-steps a second of a team of so many: a cubic lattice of 1,728 spheres, each pressed a little into its
// six neighbours (Walton-Braun corrected, incremental slip), the fastest of many short stretches. Time is
// that of the processors over the threads, whose waiting for each other is in it: what else the machine does
// counts little.
double lattice_speed(int threads);

}  // namespace grainreel
