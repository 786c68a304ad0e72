// What `grainreel bench` prints of a bed that was timed.
#pragma once

#include <string>

#include "engine/lab/bench/bench_run.hpp"

namespace grainreel {

std::string bench_json(const BenchReport& report);
// quick: with a tenth of the steps, which the table says.
std::string bench_table(const BenchReport& report, bool quick);

}  // namespace grainreel
