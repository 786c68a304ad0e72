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

HWY_INLINE void put_triple(const Triple<Lanes>& t, double* to, std::size_t stride) {
    store_records({t.x.value, t.y.value, t.z.value, Lanes(0.0).value}, to, stride);
}

// Forces on both bodies, and torques -arm * turning with turning = k x T.
template <bool rubs>
HWY_INLINE void fill(const ChunkOfContacts& chunk, LoadChunk& out) {
    constexpr std::size_t stride = sizeof(LoadChunk::Contact) / sizeof(double);
    constexpr std::size_t second = sizeof(Load) / sizeof(double);
    double* loads = reinterpret_cast<double*>(out.contact);
    for (int c = 0; c < chunk.count; c += kLanes) {
        double* to = loads + stride * c;
        const Triple<Lanes> k = take(chunk.touch->normal, c);
        Triple<Lanes> whole = k * load(chunk.force->normal + c);
        if constexpr (rubs) {
            const Triple<Lanes> across = take(chunk.force->tangential, c), turning = k.cross(across);
            whole += across;
            put_triple(-(turning * load(chunk.touch->first_arm + c)), to + 4, stride);
            put_triple(-(turning * load(chunk.touch->second_arm + c)), to + second + 4, stride);
        }
        put_triple(-whole, to, stride);
        put_triple(whole, to + second, stride);
    }
}

// What resists rolling comes on top of the torques.
void add_rolling(const ChunkOfContacts& chunk, LoadChunk& out) {
    if (!chunk.rolling) return;
    for (int c = 0; c < chunk.count; ++c) {
        const auto& torque = chunk.rolling->torque;
        const Vec3 on_second(torque[0][c], torque[1][c], torque[2][c]);
        out.contact[c].on_first.torque -= on_second;
        out.contact[c].on_second.torque += on_second;
    }
}

// Of a load: force and torque, or the force alone.
template <bool rubs>
constexpr int kNumbers = rubs ? 8 : 4;

HWY_INLINE double* numbers(Load& one) {
    return reinterpret_cast<double*>(&one);
}

template <bool rubs>
HWY_INLINE void add_one(Load& what, Load& to) {
    constexpr int n = kNumbers<rubs>;
    put(record_at<n>(numbers(to)) + record_at<n>(numbers(what)), numbers(to));
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
void pairs_of(const ChunkOfContacts& chunk, LoadChunk& scratch, std::int32_t begin, std::int32_t end,
              Grains& grains) {
    fill<rubs>(chunk, scratch);
    if (rubs) add_rolling(chunk, scratch);
    if (all_between(chunk, begin, end)) {
        for (int c = 0; c < chunk.count; ++c) {
            add_one<rubs>(scratch.contact[c].on_first, grains.load[chunk.first[c]]);
            add_one<rubs>(scratch.contact[c].on_second, grains.load[chunk.second[c]]);
        }
        return;
    }
    const auto own = [&](std::int32_t i) -> Load& {
        return i >= begin && i < end ? grains.load[i] : scratch.of_others;
    };
    for (int c = 0; c < chunk.count; ++c) {
        add_one<rubs>(scratch.contact[c].on_first, own(chunk.first[c]));
        add_one<rubs>(scratch.contact[c].on_second, own(chunk.second[c]));
    }
}

void pairs(const ChunkOfContacts& chunk, LoadChunk& scratch, std::int32_t begin, std::int32_t end,
           Grains& grains) {
    chunk.rubs ? pairs_of<true>(chunk, scratch, begin, end, grains)
               : pairs_of<false>(chunk, scratch, begin, end, grains);
}

template <bool rubs>
void walls_of(const ChunkOfContacts& chunk, LoadChunk& scratch, Grains& grains) {
    fill<rubs>(chunk, scratch);
    if (rubs) add_rolling(chunk, scratch);
    for (int c = 0; c < chunk.count; ++c) {
        add_one<rubs>(scratch.contact[c].on_first, grains.load[chunk.first[c]]);
    }
}

void walls(const ChunkOfContacts& chunk, LoadChunk& scratch, Grains& grains) {
    chunk.rubs ? walls_of<true>(chunk, scratch, grains) : walls_of<false>(chunk, scratch, grains);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(pairs);
HWY_EXPORT(walls);

void add_pairs(const ChunkOfContacts& chunk, LoadChunk& scratch, std::int32_t begin, std::int32_t end,
               Grains& grains) {
    HWY_DYNAMIC_DISPATCH(pairs)(chunk, scratch, begin, end, grains);
}

void add_walls(const ChunkOfContacts& chunk, LoadChunk& scratch, const WallState& state, double step,
               Grains& grains) {
    HWY_DYNAMIC_DISPATCH(walls)(chunk, scratch, grains);
    for (int c = 0; c < chunk.count; ++c) {
        const Vec3& velocity = state.motion[chunk.second[c]].at_end;
        grains.wall_work[chunk.first[c]] += scratch.contact[c].on_first.force.dot(velocity) * step;
    }
}

}  // namespace grainreel
#endif
