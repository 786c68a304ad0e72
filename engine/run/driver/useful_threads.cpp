#include "engine/run/driver/useful_threads.hpp"

#include <algorithm>

#include "engine/base/team.hpp"

namespace grainreel {

constexpr std::int64_t grains_a_thread = 500;  // fewer, and the barriers cost more than the company is worth

int useful_threads(int processors, std::int64_t grains) {
    return static_cast<int>(std::clamp<std::int64_t>(grains / grains_a_thread, 1, processors));
}

int engine_threads(const Scene& scene) {
    return useful_threads(scene.run.threads > 0 ? scene.run.threads : usable_processors(), scene.grains());
}

}  // namespace grainreel
