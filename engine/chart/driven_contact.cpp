#include "engine/chart/driven_contact.hpp"

#include <algorithm>

#include "engine/chart/bench.hpp"

namespace grainreel {

DrivenContact::DrivenContact(const PairPlan& pair)
    : law_(law_kernel(pair.model)), parameters_(law_.parameters({pair})), history_(law_.history_size) {
    std::fill(std::begin(mass_.value), std::end(mass_.value), 0.5 * bench_mass());
    std::fill(std::begin(radius_.value), std::end(radius_.value), 0.5 * bench_radius);
}

void DrivenContact::move(const Move& move) {
    constexpr double step = 1;  // s, that turns slips into velocities; laws without a dashpot do not see it
    for (int axis = 0; axis < 3; ++axis) {
        touch_.normal[axis][0] = move.normal[axis];
        touch_.velocity[axis][0] = move.slip[axis] / step;
    }
    touch_.overlap[0] = move.overlap;
    touch_.twist[0] = move.twist;
    touch_.touching = 1;
    LawInput in{};
    in.count = 1;
    in.touch = &touch_;
    in.effective_mass = mass_.value;
    in.effective_radius = radius_.value;
    in.parameters = &parameters_;
    in.step = step;
    in.history_stride = law_.history_size;
    law_.step(in, history_.data()->value, force_);
}

}  // namespace grainreel
