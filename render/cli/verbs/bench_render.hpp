// The verb `bench render`.
#pragma once

#include "render/cli/options/options.hpp"
#include "render/cli/report/reporter.hpp"

namespace grainreel {

// Draws a bed at rest again and again and prints milliseconds a frame by stage. Returns the exit status.
int bench_render(const Options& options, Reporter& reporter);

}  // namespace grainreel
