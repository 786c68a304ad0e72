#include "render/cli/verbs/render.hpp"

#include "render/cli/verbs/still.hpp"
#include "render/run/finished_run.hpp"
#include "render/run/redraw_run.hpp"

namespace grainreel {

int draw_again(const Options& options, Reporter& reporter) {
    FinishedRun run(options.render.run, options.sets);
    if (options.render.at) return draw_still(options, reporter, run);
    run.leave_out_damaged();
    RedrawRun redraw(options, reporter, run);
    return redraw.run();
}

}  // namespace grainreel
