#include "render/cli/verbs/movie.hpp"

#include "engine/plan/plan.hpp"
#include "engine/scene/text/reader.hpp"
#include "render/run/movie_run.hpp"

namespace grainreel {

int make_movie(const Options& options, Reporter& reporter) {
    const Scene scene = read_scene(options.scene, options.sets);
    const Plan plan = make_plan(scene);
    MovieRun run(options, reporter, scene, plan);
    return run.run();
}

}  // namespace grainreel
