// The verb `movie`: one scene becomes a film and the files beside it.
#pragma once

#include "render/cli/options/options.hpp"
#include "render/cli/report/reporter.hpp"

namespace grainreel {

// Returns the exit status: 0, 1 when the run failed on its way (what it had is kept), 129, 130 or 143 when it
// was asked to stop. Throws UserError before anything is written.
int make_movie(const Options& options, Reporter& reporter);

}  // namespace grainreel
