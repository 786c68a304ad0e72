// A whole run in one call.
#include "engine/library/internal.hpp"

#include <cmath>

#include "engine/run/folder/run_scene.hpp"
#include "grainreel/run.hpp"

namespace grainreel::v1 {
namespace {

// What look() throws goes round the driver, which would make a RunError of it.
struct Look {
    const RunOptions& options;
    std::exception_ptr thrown{};

    bool operator()(const grainreel::Frame& now) {
        try {
            return options.look(outside(now));
        } catch (...) {
            thrown = std::current_exception();
            return false;
        }
    }
};

}  // namespace

RunEnd run(const Scene& scene, const RunOptions& options) {
    if (options.threads < 0) throw Error("threads: must be at least 0");
    if (!std::isfinite(options.every) || options.every < 0) throw Error("every: must be at least 0 s");
    Look look{options};
    RunSceneOptions how;
    how.folder = options.folder;
    how.threads = options.threads;
    how.every = options.every;
    if (options.look) how.look = [&](const grainreel::Frame& now) { return look(now); };
    const SceneEnd end = told([&] { return run_scene(scene.impl().scene, how); });
    if (look.thrown) std::rethrow_exception(look.thrown);
    return {outside(end.frame), end.complete};
}

}  // namespace grainreel::v1
