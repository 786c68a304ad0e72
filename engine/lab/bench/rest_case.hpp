// A bed at rest: 4.7 contacts a grain, all of them at once. The phase "settled" of the other beds is mostly
// their fall, with half a contact to one contact a grain.
#pragma once

#include "engine/lab/bench/bench_case.hpp"

namespace grainreel {

BenchCase rest_case();

}  // namespace grainreel
