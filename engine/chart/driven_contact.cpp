#include "engine/chart/driven_contact.hpp"

#include <algorithm>

#include "engine/chart/bench.hpp"

namespace grainreel {

DrivenContact::DrivenContact(const PairPlan& pair)
    : law_(law_kernel(pair.model)), parameters_(law_.parameters({pair})) {
    history_.shape(law_.history_size, law_.number_size);
    history_.resize(1);
    std::fill_n(touch_.effective_mass, kBlock, 0.5 * bench_mass());
    std::fill_n(touch_.effective_radius, kBlock, 0.5 * bench_radius);
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
    in.parameters = &parameters_;
    in.step = step;
    in.history_stride = law_.history_size;
    law_.step(in, history_.of_block(0), force_);
}

}  // namespace grainreel
