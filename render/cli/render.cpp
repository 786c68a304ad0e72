#include "render/cli/render.hpp"

#include "render/cli/finished_run.hpp"
#include "render/cli/redraw_run.hpp"
#include "render/cli/still.hpp"

namespace grainreel {

int draw_again(const Options& options, Reporter& reporter) {
    FinishedRun run(options.render.run, options.sets);
    if (options.render.at) return draw_still(options, reporter, run);
    run.leave_out_damaged();
    RedrawRun redraw(options, reporter, run);
    return redraw.run();
}

}  // namespace grainreel
