#include "engine/step/loads.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/loads.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/vector/record-inl.hpp"
#include "engine/vector/records-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

HWY_INLINE Triple<Lanes> take(const double (*from)[kChunk], int c) {
    return {load(from[0] + c), load(from[1] + c), load(from[2] + c)};
}

// Of kLanes contacts: what the second body gains in force and the first loses, and what they lose and gain in
// torque.
struct Pushes {
    Triple<Lanes> force, first_loses, second_gains;
};

// Torques are -arm * turning with turning = k x T, for both; what resists rolling comes on top.
template <bool rubs>
HWY_INLINE Pushes pushes(const ChunkOfContacts& chunk, int c) {
    const Triple<Lanes> k = take(chunk.touch->normal, c);
    Pushes p;
    p.force = k * load(chunk.force->normal + c);
    if constexpr (rubs) {
        const Triple<Lanes> across = take(chunk.force->tangential, c), turning = k.cross(across);
        p.force += across;
        p.first_loses = turning * load(chunk.touch->first_arm + c);
        p.second_gains = -(turning * load(chunk.touch->second_arm + c));
        if (chunk.rolling) {
            const Triple<Lanes> rolling = take(chunk.rolling->torque, c);
            p.first_loses += rolling;
            p.second_gains += rolling;
        }
    }
    return p;
}

// Force and torque of one body; without friction the force alone.
HWY_INLINE double* numbers(Load& one) {
    return reinterpret_cast<double*>(&one);
}
template <bool rubs>
HWY_INLINE void add(const Record<4>& force, const Record<4>& torque, double* to) {
    put(record_at<4>(to) + force, to);
    if constexpr (rubs) put(record_at<4>(to + 4) + torque, to + 4);
}
template <bool rubs>
HWY_INLINE void subtract(const Record<4>& force, const Record<4>& torque, double* from) {
    put(record_at<4>(from) - force, from);
    if constexpr (rubs) put(record_at<4>(from + 4) - torque, from + 4);
}

HWY_INLINE Rows rows_of(const Triple<Lanes>& t) {
    return rows_of(Four<Doubles>{t.x.value, t.y.value, t.z.value, Lanes(0.0).value});
}

// first(i), second(j): the loads that those grains' pushes go to. Contact by contact, in their order.
template <bool rubs, class First, class Second>
HWY_INLINE void add_each(const ChunkOfContacts& chunk, const First& first, const Second& second) {
    for (int c = 0; c < chunk.count; c += kLanes) {
        const Pushes p = pushes<rubs>(chunk, c);
        const Rows force = rows_of(p.force);
        Rows lost{}, gained{};
        if constexpr (rubs) lost = rows_of(p.first_loses), gained = rows_of(p.second_gains);
        const auto one = [&](int k) HWY_ATTR {
            subtract<rubs>(force.row[k], lost.row[k], numbers(first(chunk.first[c + k])));
            add<rubs>(force.row[k], gained.row[k], numbers(second(chunk.second[c + k])));
        };
        if (c + kLanes <= chunk.count) {
#pragma GCC unroll 8
            for (int k = 0; k < kLanes; ++k) one(k);
        } else {
            for (int k = 0; c + k < chunk.count; ++k) one(k);
        }
    }
}

bool all_between(const ChunkOfContacts& chunk, std::int32_t begin, std::int32_t end) {
    std::int32_t outside = 0;
    for (int c = 0; c < chunk.count; ++c) {
        outside |= (chunk.first[c] - begin) | (end - 1 - chunk.first[c]);
        outside |= (chunk.second[c] - begin) | (end - 1 - chunk.second[c]);
    }
    return outside >= 0;  // no difference is negative
}

template <bool rubs>
void pairs_of(const ChunkOfContacts& chunk, LoadScratch& scratch, std::int32_t begin, std::int32_t end,
              Grains& grains) {
    const auto any = [&](std::int32_t i) HWY_ATTR -> Load& { return grains.load[i]; };
    const auto own = [&](std::int32_t i) HWY_ATTR -> Load& {
        return i >= begin && i < end ? grains.load[i] : scratch.of_others;
    };
    const bool alone = begin == 0 && end == static_cast<std::int32_t>(grains.size());
    alone || all_between(chunk, begin, end) ? add_each<rubs>(chunk, any, any)
                                            : add_each<rubs>(chunk, own, own);
}

void pairs(const ChunkOfContacts& chunk, LoadScratch& scratch, std::int32_t begin, std::int32_t end,
           Grains& grains) {
    chunk.rubs ? pairs_of<true>(chunk, scratch, begin, end, grains)
               : pairs_of<false>(chunk, scratch, begin, end, grains);
}

template <bool rubs>
void walls_of(const ChunkOfContacts& chunk, LoadScratch& scratch, Grains& grains) {
    for (int c = 0; c < chunk.count; c += kLanes) {
        const Pushes p = pushes<rubs>(chunk, c);
        store(p.force.x, scratch.force[0] + c);
        store(p.force.y, scratch.force[1] + c);
        store(p.force.z, scratch.force[2] + c);
        const Rows force = rows_of(p.force);
        Rows lost{};
        if constexpr (rubs) lost = rows_of(p.first_loses);
        for (int k = 0; k < kLanes && c + k < chunk.count; ++k)
            subtract<rubs>(force.row[k], lost.row[k], numbers(grains.load[chunk.first[c + k]]));
    }
}

void walls(const ChunkOfContacts& chunk, LoadScratch& scratch, Grains& grains) {
    chunk.rubs ? walls_of<true>(chunk, scratch, grains) : walls_of<false>(chunk, scratch, grains);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(pairs);
HWY_EXPORT(walls);

void add_pairs(const ChunkOfContacts& chunk, LoadScratch& scratch, std::int32_t begin, std::int32_t end,
               Grains& grains) {
    HWY_DYNAMIC_DISPATCH(pairs)(chunk, scratch, begin, end, grains);
}

void add_walls(const ChunkOfContacts& chunk, LoadScratch& scratch, const WallState& state, double step,
               Grains& grains) {
    HWY_DYNAMIC_DISPATCH(walls)(chunk, scratch, grains);
    for (int c = 0; c < chunk.count; ++c) {
        const Vec3& velocity = state.motion[chunk.second[c]].at_end;
        const Vec3 on_wall(scratch.force[0][c], scratch.force[1][c], scratch.force[2][c]);
        grains.wall_work[chunk.first[c]] -= on_wall.dot(velocity) * step;
    }
}

}  // namespace grainreel
#endif
