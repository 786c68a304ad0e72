#include "render/film/request/thread_plan.hpp"

#include <algorithm>

#include "engine/base/team.hpp"
#include "engine/run/driver/useful_threads.hpp"

namespace grainreel {

ThreadPlan plan_threads(int processors, bool film, std::int64_t grains) {
    const int useful = useful_threads(processors, grains);
    if (!film) return {useful, 1, 1};
    // On one or two processors the engine and the film take turns with all of them; beyond, the film gets
    // processors of its own.
    if (processors <= 2) return {std::min(useful, processors), 1, 1, true};
    const int share = std::max(1, processors / 6);
    return {std::min(useful, processors - processors / 3), share, share};
}

ThreadPlan drawing_threads(int wanted) {
    const int processors = wanted > 0 ? wanted : usable_processors();
    const int raster = std::max(1, processors / 2);
    return {0, raster, std::max(1, processors - raster)};
}

}  // namespace grainreel
