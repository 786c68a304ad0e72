// When contact lists expire, as a formula that a graphics card computes too.
#pragma once

#include <cstdint>

namespace grainreel {

// How much of what contact lists reach has been used up: the part of Reach that changes from evaluation to
// evaluation.
struct UsedUp {
    double moved;         // m; no grain has moved farther
    double fastest;       // m/s, in the last evaluation
    std::int64_t parted;  // contacts that were computed in vain
};

// Counts one more evaluation. x, y and z (m/s) are the largest components of the velocities, and `since` (s)
// is the time since the last one.
[[gnu::always_inline]] inline void use_up(UsedUp& used, double x, double y, double z, std::int64_t parted,
                                          double since) {
    used.parted += parted;
    used.fastest = __builtin_sqrt(x * x + (y * y + z * z));
    used.moved += used.fastest * (since < 0 ? -since : since);
}

// Whether the lists no longer reach far enough, or parted contacts have cost about as much as a refresh,
// which takes as long as kRefresh contacts of each grain. `skin` is how far they reach (m), and `wall_way`
// how far walls have moved (m).
[[gnu::always_inline]] inline bool are_used_up(const UsedUp& used, double skin, double wall_way,
                                               std::int64_t grains) {
    constexpr std::int64_t kRefresh = 16;
    return 2 * used.moved > skin || used.parted > kRefresh * grains || used.moved + wall_way > skin;
}

}  // namespace grainreel
