#include "engine/step/integrate.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/integrate.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// A record of four doubles, in as many registers as it takes.
struct Record {
    using D = hn::CappedTag<double, 4>;
    static constexpr int lanes = static_cast<int>(hn::MaxLanes(D()));
    static constexpr int parts = 4 / lanes;
    hn::Vec<D> part[parts];
};
HWY_INLINE Record record_at(const double* from) {
    Record r;
    for (int p = 0; p < Record::parts; ++p) r.part[p] = hn::Load(Record::D(), from + p * Record::lanes);
    return r;
}
HWY_INLINE Record record_of(double x) {
    Record r;
    for (auto& part : r.part) part = hn::Set(Record::D(), x);
    return r;
}
HWY_INLINE Record record_of(const Vec3& v) {  // the fourth number is zero
    HWY_ALIGN const double four[4] = {v.x(), v.y(), v.z(), 0};
    return record_at(four);
}
HWY_INLINE void put(const Record& r, double* to) {
    for (int p = 0; p < Record::parts; ++p) hn::Store(r.part[p], Record::D(), to + p * Record::lanes);
}
HWY_INLINE Record operator+(Record a, const Record& b) {
    for (int p = 0; p < Record::parts; ++p) a.part[p] = hn::Add(a.part[p], b.part[p]);
    return a;
}
HWY_INLINE Record operator-(Record a, const Record& b) {
    for (int p = 0; p < Record::parts; ++p) a.part[p] = hn::Sub(a.part[p], b.part[p]);
    return a;
}
HWY_INLINE Record operator*(Record a, const Record& b) {
    for (int p = 0; p < Record::parts; ++p) a.part[p] = hn::Mul(a.part[p], b.part[p]);
    return a;
}
HWY_INLINE Record larger_size(Record a, const Record& b) {
    for (int p = 0; p < Record::parts; ++p) a.part[p] = hn::Max(a.part[p], hn::Abs(b.part[p]));
    return a;
}

// Of grain i: position and radius, velocity and inverse mass, spin and inverse inertia; force and torque.
struct Numbers {
    double *place, *motion, *spin, *load;
    explicit Numbers(Grains& g)
        : place(reinterpret_cast<double*>(g.place.data())),
          motion(reinterpret_cast<double*>(g.motion.data())),
          spin(reinterpret_cast<double*>(g.spin.data())),
          load(reinterpret_cast<double*>(g.load.data())) {}
};

// (x, x, x, 0): kicks leave the fourth number of a record, its mass or inertia, as it is.
HWY_INLINE Record first_three(double x) {
    return record_of(Vec3(x, x, x));
}
HWY_INLINE Record keep_of(double x) {
    HWY_ALIGN const double four[4] = {x, x, x, 1};
    return record_at(four);
}

// A velocity or spin after half a kick; `inverse`: its mass or inertia.
HWY_INLINE Record kicked(const Record& rate, const Record& push, const Record& inverse, const Record& extra,
                         const Record& half) {
    return rate + half * (push * inverse + extra);
}

// Which halves of a step a pass over the grains makes.
template <bool ends, bool begins>
HWY_INLINE Vec3 pass(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    const Numbers at(grains);
    const Record half = first_three(0.5 * in.step), whole = first_three(in.step), nothing = record_of(0.0);
    const Record gravity = record_of(in.gravity), frame = record_of(in.frame);
    const Record keep = keep_of(in.keep), three = first_three(1);
    Record fastest = nothing;
    for (std::ptrdiff_t i = begin; i < end; ++i) {
        double *motion = at.motion + 4 * i, *load = at.load + 8 * i;
        const Record force = record_at(load), inverse_mass = record_of(motion[3]);
        Record velocity = record_at(motion);
        if (ends) velocity = kicked(velocity, force, inverse_mass, gravity, half) * keep;
        if (begins) {
            velocity = kicked(velocity, force, inverse_mass, gravity, half);
            double* place = at.place + 4 * i;
            put(record_at(place) + whole * velocity, place);
            put(nothing, load);
            fastest = larger_size(fastest, velocity - frame);
        } else {
            put(force * three + nothing, load);  // no minus zeros
        }
        put(velocity, motion);
        if (!in.rubs) continue;
        double* spin = at.spin + 4 * i;
        const Record torque = record_at(load + 4), inverse_inertia = record_of(spin[3]);
        Record rate = record_at(spin);
        if (ends) rate = kicked(rate, torque, inverse_inertia, nothing, half) * keep;
        if (begins) {
            rate = kicked(rate, torque, inverse_inertia, nothing, half);
            put(nothing, load + 4);
        } else {
            put(torque * three + nothing, load + 4);
        }
        put(rate, spin);
    }
    HWY_ALIGN double f[4];
    put(fastest, f);
    return {f[0], f[1], f[2]};
}

Vec3 first_half(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    return pass<false, true>(grains, in, begin, end);
}

Vec3 second_half(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    return pass<true, false>(grains, in, begin, end);
}

Vec3 both_halves(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    return pass<true, true>(grains, in, begin, end);
}

// A load while contacts are added to it.
struct Sum {
    Record force, torque;
    double* at;
};
HWY_INLINE Sum sum_of(double* load, bool rubs) {
    Sum s;
    s.at = load;
    s.force = record_at(load);
    if (rubs) s.torque = record_at(load + 4);
    return s;
}
HWY_INLINE void put(const Sum& s, bool rubs) {
    put(s.force, s.at);
    if (rubs) put(s.torque, s.at + 4);
}
HWY_INLINE void subtract_first(Sum& s, const double* contact, bool rubs) {
    s.force = s.force - record_at(contact);
    if (rubs) s.torque = s.torque - record_of(contact[3]) * record_at(contact + 4);
}
HWY_INLINE void add_second(double* load, const double* contact, bool rubs) {
    put(record_at(load) + record_at(contact), load);
    if (rubs) put(record_at(load + 4) - record_of(contact[7]) * record_at(contact + 4), load + 4);
}

HWY_INLINE const double* numbers(const ContactForces& c, std::ptrdiff_t which) {
    return reinterpret_cast<const double*>(c.force + which);
}

void pairs(Grains& grains, const ContactForces& contacts, bool rubs, std::int32_t begin, std::int32_t end) {
    double* load = Numbers(grains).load;
    for (std::int32_t c = 0; c < contacts.count;) {
        const std::int32_t i = contacts.first[c];
        Sum first = sum_of(load + std::ptrdiff_t{8} * std::max(i, begin), rubs);
        for (; c < contacts.count && contacts.first[c] == i; ++c) {
            const double* contact = numbers(contacts, c);
            subtract_first(first, contact, rubs);
            const std::int32_t j = contacts.second[c];  // above i, so never the one being summed
            if (j >= begin && j < end) add_second(load + std::ptrdiff_t{8} * j, contact, rubs);
        }
        if (i >= begin) put(first, rubs);
    }
}

void walls(Grains& grains, const ContactForces& contacts, bool rubs) {
    double* load = Numbers(grains).load;
    for (std::int32_t c = 0; c < contacts.count; ++c) {
        Sum first = sum_of(load + std::ptrdiff_t{8} * contacts.first[c], rubs);
        subtract_first(first, numbers(contacts, c), rubs);
        put(first, rubs);
    }
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

namespace {

// Rotates q by the angle rate * step about the rate's axis; q stays of unit length.
Quaternion turned(const Quaternion& q, const Vec3& rate, double step) {
    const double angle = rate.norm() * step;
    if (angle == 0) return q;
    return (Quaternion(Eigen::AngleAxisd(angle, rate.normalized())) * q).normalized();
}

void turn(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    if (!in.rubs || grains.orientation.empty()) return;
    for (std::int32_t i = begin; i < end; ++i) {
        grains.orientation[i] = turned(grains.orientation[i], grains.spin[i].rate, in.step);
    }
}

}  // namespace

HWY_EXPORT(first_half);
HWY_EXPORT(second_half);
HWY_EXPORT(both_halves);
HWY_EXPORT(pairs);
HWY_EXPORT(walls);

Vec3 kick_and_drift(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    const Vec3 fastest = HWY_DYNAMIC_DISPATCH(first_half)(grains, in, begin, end);
    turn(grains, in, begin, end);
    return fastest;
}

void kick(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    HWY_DYNAMIC_DISPATCH(second_half)(grains, in, begin, end);
}

Vec3 kick_and_go_on(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end) {
    const Vec3 fastest = HWY_DYNAMIC_DISPATCH(both_halves)(grains, in, begin, end);
    turn(grains, in, begin, end);
    return fastest;
}

void add_pairs(Grains& grains, const ContactForces& contacts, bool rubs, std::int32_t begin,
               std::int32_t end) {
    HWY_DYNAMIC_DISPATCH(pairs)(grains, contacts, rubs, begin, end);
}

void add_walls(Grains& grains, const ContactForces& contacts, bool rubs, const WallState& state, double step) {
    HWY_DYNAMIC_DISPATCH(walls)(grains, contacts, rubs);
    for (std::int32_t c = 0; c < contacts.count; ++c) {
        const Vec3& velocity = state.motion[contacts.second[c]].at_end;
        grains.wall_work[contacts.first[c]] -= contacts.force[c].force.dot(velocity) * step;
    }
}

}  // namespace grainreel
#endif
