#include "engine/step/loads.hpp"

#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/loads.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/laws/row-inl.hpp"
#include "engine/vector/records-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Of L::count contacts: what the second body gains in force and the first loses, and what they lose and gain
// in torque.
template <class L>
struct Pushes {
    Triple<L> force, first_loses, second_gains;
};

// Torques are -arm * turning with turning = k x T, for both; what resists rolling comes on top.
template <class L, bool rubs>
HWY_INLINE Pushes<L> pushes(const ChunkOfContacts& chunk, int c) {
    const Triple<L> k = triple_at<L>(chunk.touch->normal, c);
    const L normal = row_at<L>(chunk.force->normal, c);
    Pushes<L> p;
    if constexpr (!rubs) {
        p.force = k * normal;
    } else {
        const Triple<L> across = triple_at<L>(chunk.force->tangential, c), turning = k.cross(across);
        p.force = across.plus(k, normal);
        p.first_loses = turning * row_at<L>(chunk.touch->first_arm, c);
        p.second_gains = -(turning * row_at<L>(chunk.touch->second_arm, c));
        if (chunk.rolling) {
            const Triple<L> rolling = triple_at<L>(chunk.rolling->torque, c);
            p.first_loses += rolling;
            p.second_gains += rolling;
        }
    }
    return p;
}

HWY_INLINE double* numbers(Load& one) {
    return reinterpret_cast<double*>(&one);
}

// Force and torque of contacts on one of their bodies, contact by contact; without friction the force alone.
// They stay in registers: what is stored in one piece and loaded in another has to wait.
template <bool rubs>
HWY_INLINE auto by_contact(const Triple<Lanes>& force, const Triple<Lanes>& torque) {
    const auto four = [](const Triple<Lanes>& t) HWY_ATTR {
        return Four<Doubles>{t.x.value, t.y.value, t.z.value, Lanes(0.0).value};
    };
    if constexpr (rubs)
        return rows_of(four(force), four(torque));
    else
        return rows_of(four(force));
}
template <bool rubs>
HWY_INLINE auto by_contact(const Triple<FloatLanes>& force, const Triple<FloatLanes>& torque) {
    const auto four = [](const Triple<FloatLanes>& t) HWY_ATTR {
        return Four<Floats>{t.x.value, t.y.value, t.z.value, FloatLanes(0.0).value};
    };
    if constexpr (rubs)
        return float_rows_of(four(force), four(torque));
    else
        return float_rows_of(four(force));
}

// work<k>() for the first `count` contacts of a register, in their order.
template <class L, class Work>
HWY_INLINE void each_of(int count, const Work& work) {
    const auto in_turn = [&]<int... k>(std::integer_sequence<int, k...>) HWY_ATTR {
        if (count >= L::count)
            (work.template operator()<k>(), ...);
        else
            ((k < count ? work.template operator()<k>() : void()), ...);
    };
    in_turn(std::make_integer_sequence<int, L::count>());
}

template <int size>
HWY_INLINE void add(double* load, const Record<size>& more) {
    put(record_at<size>(load) + more, load);
}
template <int size>
HWY_INLINE void take_off(double* load, const Record<size>& less) {
    put(record_at<size>(load) - less, load);
}

// Of sorted contacts a register's second bodies come before all of its first ones: no grain notices, as its
// contacts as second body precede those as first, and loads that follow each other lie apart (1.3 times as
// fast as in turn).
template <class L, bool rubs, bool sorted>
HWY_INLINE void add_each(const ChunkOfContacts& chunk, Load* loads) {
    for (int c = 0; c < chunk.count; c += L::count) {
        chunk.touch->fetch_some();
        const Pushes<L> p = pushes<L, rubs>(chunk, c);
        const auto gained = by_contact<rubs>(p.force, p.second_gains);
        const auto lost = by_contact<rubs>(p.force, p.first_loses);
        const std::int32_t *const firsts = chunk.first + c, *const seconds = chunk.second + c;
        const auto second = [&]<int k>()
                                HWY_ATTR { add(numbers(loads[seconds[k]]), gained.template row<k>()); };
        const auto first = [&]<int k>()
                               HWY_ATTR { take_off(numbers(loads[firsts[k]]), lost.template row<k>()); };
        if constexpr (sorted) {
            each_of<L>(chunk.count - c, second);
            each_of<L>(chunk.count - c, first);
        } else {
            each_of<L>(chunk.count - c, [&]<int k>() HWY_ATTR {
                first.template operator()<k>();
                second.template operator()<k>();
            });
        }
    }
}

template <class L, bool rubs>
void pairs_of(const ChunkOfContacts& chunk, Load* loads) {
    chunk.sorted ? add_each<L, rubs, true>(chunk, loads) : add_each<L, rubs, false>(chunk, loads);
}

template <class L>
void pairs_at(const ChunkOfContacts& chunk, Load* loads) {
    chunk.rubs ? pairs_of<L, true>(chunk, loads) : pairs_of<L, false>(chunk, loads);
}

void pairs(const ChunkOfContacts& chunk, Grains& grains) {
    chunk.rounded ? pairs_at<FloatLanes>(chunk, grains.load.data())
                  : pairs_at<Lanes>(chunk, grains.load.data());
}

template <class L, bool rubs>
void walls_of(const ChunkOfContacts& chunk, LoadScratch& scratch, Grains& grains) {
    for (int c = 0; c < chunk.count; c += L::count) {
        const Pushes<L> p = pushes<L, rubs>(chunk, c);
        store_as(p.force.x, scratch.force[0] + c);
        store_as(p.force.y, scratch.force[1] + c);
        store_as(p.force.z, scratch.force[2] + c);
        const auto lost = by_contact<rubs>(p.force, p.first_loses);
        each_of<L>(chunk.count - c, [&]<int k>() HWY_ATTR {
            if (!chunk.touch->touches(c + k)) return;
            take_off(numbers(grains.load[chunk.first[c + k]]), lost.template row<k>());
        });
    }
}

template <class L>
void walls_at(const ChunkOfContacts& chunk, LoadScratch& scratch, Grains& grains) {
    chunk.rubs ? walls_of<L, true>(chunk, scratch, grains) : walls_of<L, false>(chunk, scratch, grains);
}

void walls(const ChunkOfContacts& chunk, LoadScratch& scratch, Grains& grains) {
    chunk.rounded ? walls_at<FloatLanes>(chunk, scratch, grains) : walls_at<Lanes>(chunk, scratch, grains);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(pairs);
HWY_EXPORT(walls);

void add_pairs(const ChunkOfContacts& chunk, Grains& grains) {
    HWY_DYNAMIC_DISPATCH(pairs)(chunk, grains);
}

void add_walls(const ChunkOfContacts& chunk, LoadScratch& scratch, const WallState& state, double step,
               Grains& grains) {
    HWY_DYNAMIC_DISPATCH(walls)(chunk, scratch, grains);
    for (int c = 0; c < chunk.count; ++c) {
        if (!chunk.touch->touches(c)) continue;
        const Vec3& velocity = state.motion[chunk.second[c]].at_end;
        const Vec3 on_wall(scratch.force[0][c], scratch.force[1][c], scratch.force[2][c]);
        grains.wall_work[chunk.first[c]] -= on_wall.dot(velocity) * step;
    }
}

}  // namespace grainreel
#endif
