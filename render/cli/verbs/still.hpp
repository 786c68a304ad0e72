// One frame of a finished run as a PNG file.
#pragma once

#include "render/cli/report/reporter.hpp"
#include "render/run/film_request.hpp"
#include "render/run/finished_run.hpp"

namespace grainreel {

// Draws the frame nearest to `at`, s. Returns 0. Throws UserError, with nothing written, when the
// file is there already (and --force is not given) or cannot be.
int draw_still(const FilmRequest& options, double at, Reporter& reporter, const FinishedRun& run);

}  // namespace grainreel
