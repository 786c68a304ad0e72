#include "engine/measure/bed/flight.hpp"

namespace grainreel {

void Flight::add(std::int64_t from, double carried) {
    if (!state_.flying && carried < kLeaves) {
        state_.flying = true;
        state_.since = from;
    } else if (state_.flying && carried > kLands) {
        state_.flying = false;
        if (from - state_.since < least_) return;
        state_.last = {state_.since, from};
        state_.any = true;
    }
}

}  // namespace grainreel
