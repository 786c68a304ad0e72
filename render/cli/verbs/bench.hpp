// The verb `bench`.
#pragma once

#include "render/cli/options/options.hpp"
#include "render/cli/report/reporter.hpp"

namespace grainreel {

// Returns the exit status. Throws UserError and RunError.
int run_bench(const Options& options, Reporter& reporter);

}  // namespace grainreel
