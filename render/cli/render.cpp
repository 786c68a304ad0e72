#include "render/cli/render.hpp"

#include "render/cli/finished_run.hpp"
#include "render/cli/redraw_run.hpp"
#include "render/cli/still.hpp"

namespace grainreel {

int draw_again(const Options& options, Reporter& reporter) {
    const FinishedRun run(options.render.run, options.sets);
    if (options.render.at) return draw_still(options, reporter, run);
    RedrawRun redraw(options, reporter, run);
    return redraw.run();
}

}  // namespace grainreel
