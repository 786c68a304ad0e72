// One contact at one place: geometry, law, resistance to rolling, and the pushes that the grains will sum.
// The formulas are those of the processor's kernels (engine/step/geometry, engine/laws), for one number.
#pragma once

#include "engine/card/bed.hpp"
#include "engine/card/machine-inl.hpp"
#include "engine/laws/contact_law-inl.hpp"
#include "engine/laws/rolling-inl.hpp"
#include "engine/step/forces/pushes-inl.hpp"
#include "engine/step/geometry/pair_formulas-inl.hpp"
#include "engine/step/geometry/wall_formulas-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

using card::Bed;
using card::Group;
using card::Step;
using Three = Triple<double>;

HWY_INLINE Three three_at(const double* at) {
    return {at[0], at[1], at[2]};
}

constexpr int kBlockOfPlaces = 16;  // kBlock of the processor's histories
HWY_INLINE double* history_at(const Group& g, std::int32_t place) {
    return g.history + static_cast<std::int64_t>(place / kBlockOfPlaces) * (g.history_size * kBlockOfPlaces) +
           place % kBlockOfPlaces;
}

// Visitors of the numbers of a history or of parameters, as in engine/laws/chunk-inl.hpp.
template <class Visit>
struct EachNumber {
    HWY_INLINE void turning(Three& t) const {
        const Visit& visit = *static_cast<const Visit*>(this);
        visit(t.x), visit(t.y), visit(t.z);
    }
};
struct ReadNumbers : EachNumber<ReadNumbers> {
    mutable const double* at;
    std::int64_t stride;
    HWY_INLINE ReadNumbers(const double* from, std::int64_t step) : at(from), stride(step) {}
    HWY_INLINE void operator()(double& x) const { x = *at, at += stride; }
};
struct WriteNumbers : EachNumber<WriteNumbers> {
    mutable double* at;
    HWY_INLINE explicit WriteNumbers(double* to) : at(to) {}
    HWY_INLINE void operator()(double& x) const { *at = x, at += kBlockOfPlaces; }
};

// What a law is told of a contact, with the arms of its torques.
struct Meeting {
    Touch<double> touch;
    Three velocity, rate;  // m/s; rad/s, for the resistance to rolling
    double first_arm, second_arm;
};

// Two grains.
struct PairMeets {
    Three apart;
    double radius_one, radius_two;
    const double *motion_one, *motion_two;

    HWY_INLINE PairMeets(const Bed& bed, const Step&, std::int32_t i, std::int32_t j)
        : apart(between(three_at(bed.place + 4 * static_cast<std::int64_t>(i)),
                        three_at(bed.place + 4 * static_cast<std::int64_t>(j)), bed.period)),
          radius_one(bed.place[4 * static_cast<std::int64_t>(i) + 3]),
          radius_two(bed.place[4 * static_cast<std::int64_t>(j) + 3]),
          motion_one(bed.motion + 8 * static_cast<std::int64_t>(i)),
          motion_two(bed.motion + 8 * static_cast<std::int64_t>(j)) {}
    HWY_INLINE bool begins() const { return are_closer(apart, radius_two + radius_one, 0.0); }
    HWY_INLINE double overlap(double distance) const { return radius_one + radius_two - distance; }
    HWY_INLINE double distance() const { return root(apart.squared()); }

    template <bool rubs>
    HWY_INLINE Meeting meeting(const Bed& bed, const Group& g, const Step& t, double distance) const {
        Meeting m{};
        const double inverse = 1.0 / distance;
        const Three k = apart * inverse;
        m.touch.normal = k;
        m.touch.inverse_mass = motion_one[3] + motion_two[3];
        if (g.uses_radius) m.touch.effective_radius = effective_radius_of(radius_one, radius_two);
        m.velocity = three_at(motion_one) - three_at(motion_two);
        if constexpr (rubs) {
            const Three one = three_at(motion_one + 4), two = three_at(motion_two + 4);
            m.first_arm = radius_one, m.second_arm = radius_two;
            if (bed.plane_arms) to_contact_plane(distance, inverse, m.first_arm, m.second_arm);
            const HalfTimes<double> half{0.5 * (g.at_mid_step ? t.turns : 0.0), 0.5 * t.since};
            const Swing<double> swing = swing_of_spheres(k, m.velocity, inverse, half);
            m.touch.turn = turn_by(swing, one + two, k, half);
            const Three spins = (one * m.first_arm).plus(two, m.second_arm);
            m.velocity = surface_velocity(m.velocity, spins, k, swing, half);
            m.rate = (one - two).across(k);
        }
        return m;
    }
};

// A grain at a plane or a cylinder.
struct WallMeets {
    Three into;
    double radius;
    AtWall<double> at;
    const double *motion, *wall_motion;

    HWY_INLINE WallMeets(const Bed& bed, const Step& t, std::int32_t i, std::int32_t face)
        : into(three_at(t.faces + 8 * face)),
          radius(bed.place[4 * static_cast<std::int64_t>(i) + 3]),
          motion(bed.motion + 8 * static_cast<std::int64_t>(i)),
          wall_motion(t.wall_motion + 8 * face) {
        const Three centre = three_at(bed.place + 4 * static_cast<std::int64_t>(i));
        const double* const record = t.faces + 8 * face;
        at = at_plane(centre, into, record[3]);
        if (t.any_round) or_cylinder(centre, three_at(record + 4), record[7], at);
    }
    HWY_INLINE bool begins() const { return at.distance < radius; }
    HWY_INLINE double distance() const { return at.distance; }
    HWY_INLINE double overlap(double distance) const { return radius - distance; }

    template <bool rubs>
    HWY_INLINE Meeting meeting(const Bed& bed, const Group& g, const Step& t, double distance) const {
        Meeting m{};
        const double inverse = t.any_round ? inverse_of(at.from_axis) : 0.0;
        const Three k = normal_to(at, inverse, into);
        m.touch.normal = k;
        m.touch.inverse_mass = motion[3];
        m.touch.effective_radius = radius;
        m.velocity = three_at(motion) - three_at(wall_motion);
        if constexpr (rubs) {
            const Three spin = three_at(motion + 4);
            m.first_arm = bed.plane_arms ? distance : radius;
            const HalfTimes<double> half{0.5 * (g.at_mid_step ? t.turns : 0.0), 0.5 * t.since};
            const Swing<double> swing = swing_at_wall(k, m.velocity, at.round, inverse, half);
            m.touch.turn = turn_by(swing, spin, k, half);
            m.velocity = surface_velocity(m.velocity, spin * m.first_arm, k, swing, half);
            m.rate = spin.across(k);
        }
        return m;
    }
};

HWY_INLINE void put_three(const Three& t, double* to, std::int64_t stride) {
    to[0] = t.x, to[stride] = t.y, to[2 * stride] = t.z;
}

// The kind of the contact among the parameters.
HWY_INLINE std::int32_t kind_of(const Bed& bed, const Group& g, std::int32_t i, std::int32_t j) {
    if (g.kinds == 1) return 0;
    const std::int32_t one = bed.species[i];
    return g.row[g.of_pairs ? one * g.row_species + bed.species[j] : one];
}

// Stores the pushes of a contact for its grains to sum.
template <class Law>
HWY_INLINE void put_pushes(const Group& g, const Step& t, std::int32_t place, const Meeting& m, double normal,
                           const Three& tangential, const Three& rolling) {
    Pushes<double> p{};
    if constexpr (Law::rubs) {
        p = pushes_of(m.touch.normal, normal, tangential, m.first_arm, m.second_arm);
        if (g.rolls) add_rolling(rolling, p);
    } else {
        p.force = m.touch.normal * normal;
    }
    const std::int64_t stride = g.places;
    double* const to = g.push + place;
    put_three(p.force, to, stride);
    if constexpr (Law::rubs) put_three(p.first_loses, to + 3 * stride, stride);
    if (!g.of_pairs)
        to[6 * stride] = work_of(p.force, three_at(t.wall_motion + 8 * g.second[place] + 4), t.acts);
    else if constexpr (Law::rubs)
        put_three(p.second_gains, to + 6 * stride, stride);
}

// The force of a contact that touches.
template <class Law, class Meets>
HWY_INLINE void press(const Bed& bed, const Group& g, const Step& t, std::int32_t place, const Meets& meets,
                      double distance, double overlap) {
    const std::int32_t kind = kind_of(bed, g, g.first[place], g.second[place]);
    Meeting m = meets.template meeting<Law::rubs>(bed, g, t, distance);
    m.touch.overlap = overlap;
    if constexpr (Law::uses_mass) m.touch.effective_mass = 1.0 / m.touch.inverse_mass;
    typename Law::template Parameters<double> p;
    p.each(ReadNumbers(g.parameters + kind, g.kinds));
    double* const kept = history_at(g, place);
    typename Law::template History<double> h;
    h.each(ReadNumbers(kept, kBlockOfPlaces));
    const auto force = Law::force(p, h, m.touch, m.velocity, t.since, t.ahead);
    h.each(WriteNumbers(kept));
    Three torque{0, 0, 0};
    if (Law::rubs && g.rolls) {
        RollingSpring::Parameters<double> rolls;
        rolls.each(ReadNumbers(g.rolling_parameters + kind, g.kinds));
        RollingSpring::History<double> rolled;
        double* const behind = kept + g.law_history_size * kBlockOfPlaces;
        rolled.each(ReadNumbers(behind, kBlockOfPlaces));
        torque = RollingSpring::torque(rolls, rolled, m.touch.normal, m.touch.turn, m.rate * t.since,
                                       m.touch.effective_radius, force.normal);
        rolled.each(WriteNumbers(behind));
    }
    put_pushes<Law>(g, t, place, m, force.normal, force.tangential, torque);
}

// What happens at a place in an evaluation.
template <class Law, class Meets>
HWY_INLINE void meet(const Bed& bed, const Group& g, const Step& t, std::int32_t place) {
    const std::uint8_t before = g.state[place];
    if (before == card::kEmpty) return;
    const Meets meets(bed, t, g.first[place], g.second[place]);
    if (before == card::kWaits) {
        if (!meets.begins()) return;
        g.began[place] = t.number;
    }
    const double distance = meets.distance(), overlap = meets.overlap(distance);
    if (before == card::kWaits || !(overlap > 0))
        for (int k = 0; k < g.history_size; ++k) history_at(g, place)[k * kBlockOfPlaces] = 0;
    if (!(overlap > 0)) {
        g.state[place] = card::kParted;
        add_one(bed.status->parted_now);
        return;
    }
    g.state[place] = card::kTouches;
    press<Law, Meets>(bed, g, t, place, meets, distance, overlap);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
