// The verb `render`: a finished run is drawn again, as a film or as one picture. Nothing is run.
#pragma once

#include "render/cli/options/options.hpp"
#include "render/cli/report/reporter.hpp"

namespace grainreel {

// Returns the exit status, like make_movie(). Throws UserError before anything is written.
int draw_again(const Options& options, Reporter& reporter);

}  // namespace grainreel
