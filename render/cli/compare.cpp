#include "render/cli/compare.hpp"

#include "render/cli/compare_run.hpp"

namespace grainreel {

int make_comparison(const Options& options, Reporter& reporter) {
    CompareRun run(options, reporter, read_comparison(options));
    return run.run();
}

}  // namespace grainreel
