// One grain: its motion up to the forces, and the sum of the pushes of its contacts. And once for all:
// whether the contact lists have expired.
#pragma once

#include "engine/card/contact-inl.hpp"
#include "engine/step/motion/kicks-inl.hpp"

HWY_BEFORE_NAMESPACE();
#include "engine/step/lists/expiry.hpp"
namespace grainreel::HWY_NAMESPACE {

constexpr double kNoMotionOnCard = 1e-60;  // kNoMotion (engine/step/motion/integrate.hpp)

// A component of a velocity or a spin after the kicks.
HWY_INLINE double component_after(double now, double gains, const Step& t) {
    const Kicks<double> kicks{t.end_kick, t.begin_kick, t.keep};
    if (t.begins_run)
        return t.drags ? kicked<false, true, true>(now, gains, kicks, kNoMotionOnCard)
                       : kicked<false, true, false>(now, gains, kicks, kNoMotionOnCard);
    return t.drags ? kicked<true, true, true>(now, gains, kicks, kNoMotionOnCard)
                   : kicked<true, true, false>(now, gains, kicks, kNoMotionOnCard);
}

HWY_INLINE void move_grain(const Bed& bed, const Step& t, std::int32_t grain) {
    const std::int64_t i = grain;
    double *const place = bed.place + 4 * i, *const motion = bed.motion + 8 * i;
    const double* const load = bed.load + 8 * i;
    for (int a = 0; a < 3; ++a) {
        const double gains = multiply_add(load[a], motion[3], t.gravity[a]);
        const double v = component_after(motion[a], gains, t);
        motion[a] = v;
        place[a] = t.begins_run || t.closing_drift == 0
                       ? drifted<false>(place[a], v, t.closing_drift, t.drift)
                       : drifted<true>(place[a], v, t.closing_drift, t.drift);
        raise(bed.told[t.told].fastest[a], size_of(v - t.frame[a]));
    }
    for (int a = 4; bed.rubs && a < 7; ++a)
        motion[a] = component_after(motion[a], multiply_add(load[a], motion[7], 0.0), t);
}

// Counts an evaluation. Kernels do nothing more once the lists have expired.
HWY_INLINE void count_evaluation(const Bed& bed, const Step& t) {
    card::Status& status = *bed.status;
    card::Told& told = bed.told[t.told];
    const auto number = [](std::uint64_t bits) { return __builtin_bit_cast(double, bits); };
    told.parted = status.parted_now;
    status.parted_now = 0;
    UsedUp used{status.moved, status.fastest, status.parted_in_all};
    use_up(used, number(told.fastest[0]), number(told.fastest[1]), number(told.fastest[2]), told.parted,
           t.since);
    status.moved = used.moved, status.fastest = used.fastest, status.parted_in_all = used.parted;
    status.expired = are_used_up(used, t.skin, t.wall_way, bed.grains);
    ++status.evaluations;
}

// Adds the pushes of one contact to a load, and to the work of walls.
HWY_INLINE void add_pushes(const Group& g, std::int32_t entry, double* load, double& work) {
    const std::int32_t place = entry / 2;
    if (g.state[place] != card::kTouches) return;
    const std::int64_t stride = g.places;
    const double* const push = g.push + place;
    const bool second = entry % 2 != 0;
    for (int a = 0; a < 3; ++a) load[a] = second ? load[a] + push[a * stride] : load[a] - push[a * stride];
    for (int a = 0; g.rubs && a < 3; ++a)
        load[4 + a] = second ? load[4 + a] + push[(6 + a) * stride] : load[4 + a] - push[(3 + a) * stride];
    if (!g.of_pairs) work += push[6 * stride];
}

// Takes the candidates that became contacts in this evaluation among the late contacts of a grain. Returns
// how many there are.
HWY_INLINE std::int32_t take_late(const Group& g, const Step& t, std::int32_t i) {
    std::int32_t count = g.late_count[i];
    for (std::int32_t e = g.candidates.start[i]; e < g.candidates.start[i + 1]; ++e) {
        const std::int32_t entry = g.candidates.at[e];
        if (g.state[entry / 2] <= card::kWaits || g.began[entry / 2] != t.number) continue;
        g.late_at[g.late_start[i] + count++] = entry;
    }
    g.late_count[i] = count;
    return count;
}

// Sums a grain's contacts in the order of the processor: groups from last to first; in each those that began
// lately, in the order in which they began, then the sorted ones.
HWY_INLINE void sum_grain(const Bed& bed, const Step& t, std::int32_t i) {
    double load[8] = {}, work = bed.wall_work[i];
    for (std::int32_t n = bed.groups - 1; n >= 0; --n) {
        const Group& g = bed.group[n];
        const std::int32_t late = take_late(g, t, i);
        for (std::int32_t e = 0; e < late; ++e) add_pushes(g, g.late_at[g.late_start[i] + e], load, work);
        for (std::int32_t e = g.sorted.start[i]; e < g.sorted.start[i + 1]; ++e)
            add_pushes(g, g.sorted.at[e], load, work);
    }
    for (int a = 0; a < 8; ++a) bed.load[8 * static_cast<std::int64_t>(i) + a] = load[a];
    bed.wall_work[i] = work;
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
