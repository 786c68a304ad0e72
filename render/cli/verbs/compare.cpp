#include "render/cli/verbs/compare.hpp"

#include "render/run/compare/compare_run.hpp"

namespace grainreel {

int make_comparison(const Options& options, Reporter& reporter) {
    CompareRun run(options, reporter, read_comparison(options));
    return run.run();
}

}  // namespace grainreel
