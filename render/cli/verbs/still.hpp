// One frame of a finished run as a PNG file.
#pragma once

#include "render/cli/options/options.hpp"
#include "render/cli/report/reporter.hpp"
#include "render/run/finished_run.hpp"

namespace grainreel {

// Draws the frame nearest to options.render.at. Returns 0. Throws UserError, with nothing written, when the
// file is there already (and --force is not given) or cannot be.
int draw_still(const Options& options, Reporter& reporter, const FinishedRun& run);

}  // namespace grainreel
