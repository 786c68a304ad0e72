// The verb `compare`: several scenes, or finished runs, in one film, side by side and in step.
#pragma once

#include "render/cli/options/options.hpp"
#include "render/cli/report/reporter.hpp"

namespace grainreel {

// Returns the exit status, like make_movie(). Throws UserError before anything is written.
int make_comparison(const Options& options, Reporter& reporter);

}  // namespace grainreel
