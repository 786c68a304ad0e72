#include "engine/lab/chart/accuracy/driven_contact.hpp"

#include "engine/lab/chart/bench.hpp"

namespace grainreel {

DrivenContact::DrivenContact(const PairPlan& pair)
    : law_(law_kernel(pair.model)), parameters_(law_.parameters({pair})) {
    history_.shape(law_.history_size, law_.number_size);
    history_.resize(1);
    for (int c = 0; c < kBlock; ++c) {
        touch_.inverse_mass.set(c, 2 / bench_mass(), law_.number_size);
        touch_.effective_radius.set(c, 0.5 * bench_radius, law_.number_size);
    }
}

// Cayley's vector: from the last normal to this one on the shortest way, then the twist, of which the step
// loop takes the half for tan(twist / 2).
Vec3 DrivenContact::turn_of(const Move& move) const {
    const Vec3& k = move.normal;
    const Vec3 tilt = normal_.cross(k) / (1 + normal_.dot(k));
    return tilt + 0.5 * move.twist * (k + k.cross(tilt));
}

void DrivenContact::move(const Move& move) {
    const Vec3 turn = turn_of(move);
    normal_ = move.normal;
    constexpr double step = 1;  // s, that turns slips into velocities; laws without a dashpot do not see it
    for (int axis = 0; axis < 3; ++axis) {
        touch_.normal[axis].set(0, move.normal[axis], law_.number_size);
        touch_.velocity[axis].set(0, move.slip[axis] / step, law_.number_size);
        touch_.turn[axis].set(0, turn[axis], law_.number_size);
    }
    touch_.overlap.set(0, move.overlap, law_.number_size);
    touch_.touching = 1;
    LawInput in{};
    in.count = 1;
    in.touch = &touch_;
    in.parameters = &parameters_;
    in.step = step;
    in.history_stride = law_.history_size;
    law_.step_one_kind(in, history_.of_block(0), force_);
}

double DrivenContact::normal_force() const {
    return force_.normal.get(0, law_.number_size);
}

Vec3 DrivenContact::tangential() const {
    const auto along = [this](int axis) { return force_.tangential[axis].get(0, law_.number_size); };
    return {along(0), along(1), along(2)};
}

}  // namespace grainreel
