#include "engine/step/forces/loads.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/forces/loads.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/step/forces/loads-inl.hpp"
#include "engine/step/forces/pushes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Forces and torques of L::count contacts.
template <class L, bool rubs>
HWY_INLINE Pushes<L> pushes(const ChunkOfContacts& chunk, int c) {
    const Triple<L> k = triple_at<L>(chunk.touch->normal, c);
    const L normal = row_at<L>(chunk.force->normal, c);
    Pushes<L> p;
    if constexpr (!rubs) {
        p.force = k * normal;
    } else {
        p = pushes_of(k, normal, triple_at<L>(chunk.force->tangential, c),
                      row_at<L>(chunk.touch->first_arm, c), row_at<L>(chunk.touch->second_arm, c));
        if (chunk.rolling) add_rolling(triple_at<L>(chunk.rolling->torque, c), p);
    }
    return p;
}

// In a register of sorted contacts, the loads of all second bodies are added before those of all first
// bodies. This changes no sum, because a grain's contacts as second body come before those as first body
// anyway. Successive additions then go to places far apart in memory, which is 1.3 times as fast as adding to
// first and second bodies in turn.
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

// The work (J) that walls do on their grains. `force` is the force on the wall.
template <class L>
HWY_INLINE void put_work(const WallLoads& in, int c, const Triple<L>& force, double* work) {
    alignas(64) double rows[3][L::count];
    store_as(force.x, rows[0]), store_as(force.y, rows[1]), store_as(force.z, rows[2]);
    const auto* at_end = reinterpret_cast<const double*>(in.walls.motion.data()) + 4;
    for (int k = 0; k < L::count; k += kLanes) {
        const auto v = load_bundles(at_end, sizeof(FaceMotion) / sizeof(double), in.contacts.second + c + k);
        const Triple<Lanes> on_wall{load(rows[0] + k), load(rows[1] + k), load(rows[2] + k)};
        store(work_of(on_wall, {v.a, v.b, v.c}, in.step), work + k);
    }
}

// Tallies the forces on the faces. The forces on the grains do not depend on this.
template <class L>
void note(const WallLoads& in, int c, const Triple<L>& force) {
    const ChunkOfContacts& chunk = in.contacts;
    const std::size_t size = chunk.rounded ? sizeof(float) : sizeof(double);
    alignas(64) double rows[3][L::count];
    store_as(force.x, rows[0]), store_as(force.y, rows[1]), store_as(force.z, rows[2]);
    for (int k = 0; k < std::min(L::count, chunk.count - c); ++k) {
        if (!chunk.touch->touches(c + k)) continue;
        const std::int32_t face = chunk.second[c + k];
        const Place& grain = in.grains.place[chunk.first[c + k]];
        const Row* const normal = chunk.touch->normal;
        const Vec3 out(normal[0].get(c + k, size), normal[1].get(c + k, size), normal[2].get(c + k, size));
        // The point of the surface. On a glued grain it is where the lever arm ends; without friction, the
        // place along the normal makes no difference to the moment.
        const double reach = chunk.of_glued && chunk.rubs
                                 ? chunk.touch->first_arm.get(c + k, size)
                                 : grain.radius - chunk.touch->overlap.get(c + k, size);
        Vec3 couple(0, 0, 0);
        if (chunk.rolling)
            for (int a = 0; a < 3; ++a) couple[a] = chunk.rolling->torque[a].get(c + k, size);
        in.walls.tally->add(face, Vec3(rows[0][k], rows[1][k], rows[2][k]),
                            chunk.force->normal.get(c + k, size),
                            grain.position + reach * out - in.walls.faces[face].axis, couple);
    }
}

template <class L, bool rubs>
void walls_of(const WallLoads& in) {
    const ChunkOfContacts& chunk = in.contacts;
    alignas(64) double work[L::count];
    for (int c = 0; c < chunk.count; c += L::count) {
        const Pushes<L> p = pushes<L, rubs>(chunk, c);
        put_work<L>(in, c, p.force, work);
        if (in.walls.tally) note<L>(in, c, p.force);
        const auto lost = by_contact<rubs>(p.force, p.first_loses);
        each_of<L>(chunk.count - c, [&]<int k>() HWY_ATTR {
            if (!chunk.touch->touches(c + k)) return;
            const std::int32_t grain = chunk.first[c + k];
            take_off(numbers(in.grains.load[grain]), lost.template row<k>());
            in.grains.wall_work[grain] += work[k];
        });
    }
}

template <class L>
void walls_at(const WallLoads& in) {
    in.contacts.rubs ? walls_of<L, true>(in) : walls_of<L, false>(in);
}

void add_to_walls(const WallLoads& in) {
    in.contacts.rounded ? walls_at<FloatLanes>(in) : walls_at<Lanes>(in);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(pairs);
HWY_EXPORT(add_to_walls);

void add_pairs(const ChunkOfContacts& chunk, Grains& grains) {
    HWY_DYNAMIC_DISPATCH(pairs)(chunk, grains);
}

void add_walls(const WallLoads& forces) {
    HWY_DYNAMIC_DISPATCH(add_to_walls)(forces);
}

}  // namespace grainreel
#endif
