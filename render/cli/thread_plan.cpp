#include "render/cli/thread_plan.hpp"

#include <algorithm>

namespace grainreel {

ThreadPlan plan_threads(int processors, bool film) {
    if (!film) return {processors, 1, 1};
    // On one or two processors the engine keeps its threads and the film's take turns with them; beyond, the
    // film gets processors of its own.
    const int share = std::max(1, processors / 6);
    return {processors <= 2 ? processors : processors - processors / 3, share, share};
}

}  // namespace grainreel
