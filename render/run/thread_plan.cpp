#include "render/run/thread_plan.hpp"

#include <algorithm>

#include "engine/base/team.hpp"

namespace grainreel {

constexpr std::int64_t grains_a_thread = 500;  // fewer, and the barriers cost more than the company is worth

ThreadPlan plan_threads(int processors, bool film, std::int64_t grains) {
    const int useful = static_cast<int>(std::clamp<std::int64_t>(grains / grains_a_thread, 1, processors));
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
