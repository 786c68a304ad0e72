#include "engine/step/forces/contact_forces.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

#include "engine/step/forces/law_input.hpp"
#include "engine/step/forces/loads.hpp"
#include "engine/step/lists/large_bed.hpp"

namespace grainreel {

namespace {

// The same input, with what does not count in this step.
ForceInput with_screens(ForceInput in, const ThreadContacts& contacts, Halo* halo, Screens& screens) {
    if (contacts.screens.empty()) return in;
    screens.find(in, contacts, halo);
    in.screens = &screens;
    return in;
}

// Gives new contacts with faces the histories with which they go on.
void give_to_heirs(const ForceInput& in, std::size_t g, ContactTable& table) {
    const ContactGroup& group = in.rules.groups[g];
    for (const Screens::Heir& heir : in.screens->heirs()) {
        const bool is_face = heir.wall < std::ssize(in.walls.faces);
        if (!is_face || in.rules.group_of_wall[in.grains.species[heir.grain]] != static_cast<std::int32_t>(g))
            continue;
        const std::int32_t c = table.place_of(heir.grain, heir.wall);
        for (int k = 0; c >= 0 && k < group.law_size(); ++k) table.histories().set(c, k, heir.numbers[k]);
    }
}

// Adds the forces in `memory` to the loads of the chunk's grains.
void add_loads(const ForceInput& in, const ContactGroup& group, const Chunk& chunk, bool rounded, bool sorted,
               const ChunkMemory& memory, Grains& grains) {
    const ChunkOfContacts forces{.first = chunk.first_at,
                                 .second = group.of_glued ? memory.face : chunk.second_at,
                                 .count = chunk.count,
                                 .touch = &memory.touch,
                                 .force = &memory.force,
                                 .rubs = group.law->rubs,
                                 .rolling = group.rolling ? &memory.rolling : nullptr,
                                 .rounded = rounded,
                                 .sorted = sorted,
                                 .of_glued = group.of_glued};
    if (group.of_pairs) return add_pairs(forces, grains);
    const WallLoads at_walls{forces, in.walls, in.times.acts, grains};
    if (group.of_mesh) return add_at_meshes(at_walls);
    in.walls.turning && !group.of_glued ? add_at_points(at_walls, false) : add_walls(at_walls);
}

}  // namespace

// Contacts go through geometry, law and loads a chunk at a time, so that a chunk stays in the cache. Contacts
// at walls come before contacts of pairs. In each group, the contacts that began since the last refresh come
// first.
void add_contact_forces(const ForceInput& forces, Grains& grains, ThreadContacts& contacts,
                        ChunkMemory& memory, Vanguard& vanguard, CostClock& clock) {
    const ForceInput in = with_screens(forces, contacts, &contacts.halo, memory.screens);
    for (std::size_t g = contacts.tables.size(); g-- > 0;) {
        const ContactGroup& group = in.rules.groups[g];
        const bool rounded = group.number_size() == sizeof(float);
        ContactTable& table = contacts.tables[g];
        group.of_mesh ? find_patches(in, g, contacts, memory.matcher) : add_new_contacts(in, g, contacts);
        table.each_chunk([&](std::int32_t c, int count) {
            const bool sorted = c < table.sorted(), large = group.of_pairs && sorted && is_large_bed(grains);
            memory.touch.ahead = large ? &memory.ahead : nullptr;
            if (large) look_ahead(grains, rounded, table, c, count, memory.ahead);
            const auto [first, second] = contacts.bodies_of(in.rules, g, c, count);
            const MeshTouch* const mesh = group.of_mesh ? contacts.meshes[g].touch.data() + c : nullptr;
            const Chunk chunk{table.first() + c, table.second() + c, first, second, count, mesh};

            const LawInput law = law_input(in, group, chunk, rounded, memory);
            table.note_touching(c, memory.touch.touching);
            // From here to the formula: step_chunk() (engine/laws/kernel-inl.hpp) loads a register of
            // contacts, and LawPair::force() (contact_law-inl.hpp) joins the two laws. The force() of a law
            // is the formula: SpringDashpot::force() (spring_dashpot-inl.hpp), LinearSpring::force()
            // (linear_spring-inl.hpp) and so on.
            const auto step = are_of_one_kind(group, law) ? group.law->step_one_kind : group.law->step;
            void* history = table.histories().of_block(c);
            step(law, history, memory.force);
            if (group.rolling)
                group.rolling->step(for_rolling(group, law), behind_law(group, history), memory.force);
            if (group.of_mesh) remember_patches(group, mesh, memory, c, count, table.histories());
            clock.lap(group.of_pairs ? Cost::contacts : Cost::walls);

            add_loads(in, group, chunk, rounded, sorted, memory, grains);
            clock.lap(group.of_pairs ? Cost::gather : Cost::walls);

            // The sorted contacts of the first group come last of all. So grains below the first grain of the
            // next contact already have all their forces.
            if (g != 0 || !sorted || c + count == table.sorted()) return;
            advance(vanguard, grains, table.first()[c + count]);
            clock.lap(Cost::integrate);
        });
    }
    advance(vanguard, grains, contacts.end);
    clock.lap(Cost::integrate);
}

namespace {

// Keeps the fault of the earliest step, and within a step the fault of the grain with the lowest id. A fault
// of this step has no step number yet (it is below 0).
void note(const MeshFault& fault, std::optional<MeshFault>& first) {
    if (!first || (first->step < 0 && fault.grain < first->grain)) first = fault;
}

// Copies numbers of up to kBlock contacts side by side, because rows and histories hold a block's contacts in
// the same order.
template <class Number>
void remember(const ContactGroup& group, const MeshTouch* touch, const ChunkMemory& memory, std::int32_t c,
              int count, Histories& histories) {
    const int behind = group.law_size();
    for (int begin = 0; begin < count; begin += kBlock) {
        const int size = std::min(kBlock, count - begin);
        auto* const to = static_cast<Number*>(histories.of_block(c + begin)) + behind * kBlock;
        const std::uint64_t touches = memory.touch.touching >> begin;
        const auto keep = [&](int number, const Row& row) {
            const Number* const from = row.of<Number>() + begin;
            for (int k = 0; k < size; ++k) to[number * kBlock + k] = touches >> k & 1 ? from[k] : 0;
        };
        for (int k = 0; k < size; ++k)
            to[kTriangle * kBlock + k] =
                touches >> k & 1 ? static_cast<Number>(touch[begin + k].triangle) : 0;
        for (int a = 0; a < 3; ++a) keep(kNormalX + a, memory.touch.normal[a]);
        keep(kForce, memory.force.normal);
    }
}

}  // namespace

void find_patches(const ForceInput& in, std::size_t g, ThreadContacts& contacts, PatchMatcher& matcher) {
    const ContactGroup& group = in.rules.groups[g];
    ContactTable& table = contacts.tables[g];
    MeshLists& lists = contacts.meshes[g];
    table.begin_step();
    for (MeshTouch& touch : lists.touch) touch.distance = MeshTouch::kApart;
    lists.touch.resize(MeshLists::places_for(table.size()));
    for (MeshNear& near : lists.near) {
        // The numbers of new patches rise: patches come by rising triangle, and each new one takes the lowest
        // free number.
        for (const MatchedPatch& patch : matcher.match(in, in.meshes, group, near, lists, table)) {
            std::int32_t c = near.contact[patch.number];
            if (c == MeshNear::kNone) {
                c = table.add_new(near.grain, near.mesh * kMostPatches + patch.number);
                near.set_contact(patch.number, c);
                lists.touch.resize(MeshLists::places_for(table.size()));
            } else if (!patch.goes_on) {
                table.histories().clear(c);
            }
            for (int k = 0; patch.heir && k < group.law_size(); ++k)
                table.histories().set(c, k, patch.heir->numbers[k]);
            lists.touch[c] = patch.touch;
        }
        if (matcher.fault()) note(*matcher.fault(), contacts.fault);
    }
    const std::int32_t first_new = table.end_step();
    contacts.note_loaded(in.rules, g, first_new, table.size());
}

void remember_patches(const ContactGroup& group, const MeshTouch* touch, const ChunkMemory& memory,
                      std::int32_t c, int count, Histories& histories) {
    group.number_size() == sizeof(float) ? remember<float>(group, touch, memory, c, count, histories)
                                         : remember<double>(group, touch, memory, c, count, histories);
}

namespace {

// Leaves out those of the candidates from c on that do not count. `which` has a bit for each.
std::uint64_t without_screened(const ForceInput& in, std::size_t g, const ContactTable& table, std::int32_t c,
                               std::uint64_t which) {
    if (!in.screens || !in.screens->any()) return which;
    for (std::uint64_t left = which; left != 0; left &= left - 1) {
        const int k = std::countr_zero(left);
        if (in.screens->screens(static_cast<std::int32_t>(g), table.near_first()[c + k],
                                table.near_second()[c + k]))
            which &= ~(std::uint64_t{1} << k);
    }
    return which;
}

// Makes contacts of those candidates [from, to) of a group that touch; `from` is a multiple of kChunk.
void admit_all(const ForceInput& in, std::size_t g, ThreadContacts& contacts, std::int32_t from,
               std::int32_t to) {
    const ContactGroup& group = in.rules.groups[g];
    ContactTable& table = contacts.tables[g];
    for (std::int32_t c = from; c < to; c += kChunk) {
        const auto bodies = contacts.found[g].candidates.of(table.near_first(), table.near_second(), c);
        if (group.of_pairs && is_large_bed(in.grains)) fetch_places(in.grains, table, c);
        table.admit(
            c, without_screened(in, g, table, c, which_touch(in, group, bodies, std::min(kChunk, to - c))));
    }
}

// Lists those candidates of one stretch of the list that are closer than `gap` (m).
void list_soon(const ForceInput& in, const ContactTable& table, const FoundPairs& candidates, SoonList& soon,
               double gap) {
    soon.begin(in.times.moved, gap);
    for (std::int32_t c = soon.from(); c < soon.to(); c += kChunk) {
        const int count = std::min(kChunk, soon.to() - c);
        const auto [first, second] = candidates.of(table.near_first(), table.near_second(), c);
        std::uint64_t left = near_pairs(in.grains, first, second, count, in.rules.period, gap);
        left &= bits_of_first(count) & ~table.admitted(c);
        if (!soon.has_room(std::popcount(left))) return soon.give_up();
        for (; left != 0; left &= left - 1) {
            const int k = std::countr_zero(left);
            soon.add(first[k], second[k], c + k);
        }
    }
    soon.end();
}

void admit_soon(const ForceInput& in, std::size_t g, ThreadContacts& contacts, const SoonList& soon) {
    if (soon.are_all()) return admit_all(in, g, contacts, soon.from(), soon.to());
    for (std::int32_t k = 0; k < soon.size(); k += kChunk) {
        const Halo::Bodies bodies{soon.first() + k, soon.second() + k};
        std::uint64_t left = which_touch(in, in.rules.groups[g], bodies, std::min(kChunk, soon.size() - k));
        for (; left != 0; left &= left - 1) {
            const std::int32_t at = soon.at(k + std::countr_zero(left)), c = at / kChunk * kChunk;
            ContactTable& table = contacts.tables[g];
            table.admit(c, without_screened(in, g, table, c, std::uint64_t{1} << at % kChunk));
        }
    }
}

// For the pairs of a small bed, a step tests only the candidates that may touch soon. In a large bed it tests
// all, because this brings their places to the cache, where contacts need them soon after. (With lists of
// near candidates, contacts took 1.15 times as long there.)
//
// kShare is a compromise: a small gap lets in few pairs, and a large gap makes a list last longer.
void admit_soon(const ForceInput& in, std::size_t g, ThreadContacts& contacts) {
    constexpr double kShare = 1.0 / 10;
    contacts.soon[g].each(kShare * contacts.skin, [&](SoonList& soon, double gap) {
        if (!soon.lasts(in.times.moved))
            list_soon(in, contacts.tables[g], contacts.found[g].candidates, soon, gap);
        admit_soon(in, g, contacts, soon);
    });
}

}  // namespace

void add_new_contacts(const ForceInput& in, std::size_t g, ThreadContacts& contacts) {
    ContactTable& table = contacts.tables[g];
    const ContactGroup& group = in.rules.groups[g];
    table.begin_step();
    if (group.of_pairs && !is_large_bed(in.grains))
        admit_soon(in, g, contacts);
    else
        admit_all(in, g, contacts, 0, table.candidates());
    const std::int32_t first_new = table.end_step();
    contacts.note_loaded(in.rules, g, first_new, table.size());
    if (in.screens && !group.of_pairs && !group.of_glued) give_to_heirs(in, g, table);
}

namespace {

// Number of the wall that the second body is, or to which it belongs.
std::int32_t wall_of(const ForceInput& in, const ContactGroup& group, std::int32_t second) {
    if (group.of_mesh) return static_cast<std::int32_t>(in.walls.faces.size()) + mesh_of(second);
    return group.of_glued ? in.glued.face[second] : second;
}

// Distance (m) of the point where a grain touches another body from the grain's centre. On a wall (`other` is
// 0) it is the point of the surface, between spheres it lies in the plane of the circle in which they
// intersect. The lever arms of the torques end there too (LeverArms::contact_plane).
double distance_of_point(double radius, double other, double overlap) {
    if (other == 0) return radius - overlap;
    const double reach = radius + other, distance = reach - overlap;
    return 0.5 * (distance + (radius - other) * (reach / distance));
}

ContactView view_of(const ForceInput& in, const ContactGroup& group, const Chunk& chunk, int at,
                    const ChunkMemory& of, const EnergyChunk& energy) {
    const auto vector = [at](const Row* axes) { return Vec3(axes[0][at], axes[1][at], axes[2][at]); };
    const std::int32_t first = chunk.first[at], second = chunk.second[at];
    const Place& one = in.grains.place[first];
    ContactView v{};
    v.first = first;
    v.glued = group.of_glued ? second : -1;
    v.second = group.of_pairs ? second : -1 - wall_of(in, group, second);
    v.triangle = chunk.mesh ? static_cast<std::int32_t>(chunk.mesh[at].triangle) : -1;
    v.normal = vector(of.touch.normal);
    v.overlap = of.touch.overlap[at];
    v.smaller_radius = one.radius;
    if (group.of_pairs) v.smaller_radius = std::min(one.radius, in.grains.place[second].radius);
    if (group.of_glued) v.smaller_radius = std::min(one.radius, in.glued.place[second].radius);
    v.normal_force = of.force.normal[at];
    v.tangential = group.law->rubs ? vector(of.force.tangential) : Vec3::Zero();
    const Vec3 turning = v.normal.cross(v.tangential);
    const Vec3 rolling = group.law->rubs && group.rolling ? vector(of.rolling.torque) : Vec3::Zero();
    v.rolling = rolling;
    v.torque_on_first = v.torque_on_second = Vec3::Zero();
    if (group.law->rubs) v.torque_on_first = -of.touch.first_arm[at] * turning - rolling;
    if (group.law->rubs && group.of_pairs) v.torque_on_second = -of.touch.second_arm[at] * turning + rolling;
    v.stored_energy = energy.stored[at];
    v.sideways_energy = energy.sideways[at];
    v.latched_energy = energy.latched[at];
    v.damping_power = energy.damping[at];
    v.rubbing_power = energy.rubbing[at];
    const double other = group.of_pairs   ? in.grains.place[second].radius
                         : group.of_glued ? in.glued.place[second].radius
                                          : 0;
    v.point = one.position + v.normal * distance_of_point(one.radius, other, v.overlap);
    return v;
}

// Shows the contacts of a chunk that touch and whose first body is one of the thread's own grains.
template <class See>
void see_chunk(const ForceInput& in, const ContactGroup& group, const Chunk& chunk, const void* history,
               std::int32_t first_own, ChunkMemory& memory, const See& see) {
    EnergyChunk energy;
    const LawInput law = law_input(in, group, chunk, false, memory);
    group.law->observe(law, history, memory.force, energy);
    if (group.rolling)
        group.rolling->observe(for_rolling(group, law), behind_law(group, history), memory.force, energy);
    for (int k = 0; k < chunk.count; ++k) {
        if ((memory.touch.touching >> k & 1) && chunk.first[k] >= first_own)
            see(view_of(in, group, chunk, k, memory, energy));
    }
}

// Shows a contact that has no history.
template <class See>
void see_alone(const ForceInput& in, const ContactGroup& group, std::int32_t one, std::int32_t other,
               const MeshTouch* mesh, std::int32_t first_own, ChunkMemory& memory, const See& see) {
    Histories none;
    none.shape(group.history_size(), group.number_size());
    none.resize(kBlock);
    std::int32_t first[kBlock], second[kBlock];
    std::fill_n(first, kBlock, one);
    std::fill_n(second, kBlock, other);
    MeshTouch touch[kBlock];
    if (mesh) touch[0] = *mesh;
    see_chunk(in, group, {first, second, first, second, 1, mesh ? touch : nullptr}, none.of_block(0),
              first_own, memory, see);
}

// Grains may have moved since the forces were computed, so candidates that are not contacts yet may touch.
template <class See>
void see_candidates(const ForceInput& in, std::size_t g, const ThreadContacts& contacts, ChunkMemory& memory,
                    const See& see) {
    const ContactGroup& group = in.rules.groups[g];
    const ContactTable& table = contacts.tables[g];
    for (std::int32_t c = 0; c < table.candidates(); c += kChunk) {
        const Halo::Bodies bodies{table.near_first() + c, table.near_second() + c};
        std::uint64_t left = which_touch(in, group, bodies, std::min(kChunk, table.candidates() - c));
        left = without_screened(in, g, table, c, left);
        for (left &= ~table.admitted(c); left != 0; left &= left - 1) {
            const int k = std::countr_zero(left);
            see_alone(in, group, bodies.first[k], bodies.second[k], nullptr, contacts.begin, memory, see);
        }
    }
}

// Finds where the contacts with meshes touch now. Shows the patches that are touched but have no contact yet.
template <class See>
std::vector<MeshTouch> see_new_patches(const ForceInput& in, std::size_t g, const ThreadContacts& contacts,
                                       ChunkMemory& memory, const See& see) {
    const ContactGroup& group = in.rules.groups[g];
    const ContactTable& table = contacts.tables[g];
    const MeshLists& lists = contacts.meshes[g];
    std::vector<MeshTouch> touch(MeshLists::places_for(table.size()));
    for (const MeshNear& near : lists.near) {
        for (const MatchedPatch& patch : memory.matcher.match(in, in.meshes, group, near, lists, table)) {
            const std::int32_t second = near.mesh * kMostPatches + patch.number;
            if (patch.goes_on)
                touch[near.contact[patch.number]] = patch.touch;
            else
                see_alone(in, group, near.grain, second, &patch.touch, contacts.begin, memory, see);
        }
    }
    return touch;
}

}  // namespace

void view_contacts(const ForceInput& forces, std::size_t g, const ThreadContacts& contacts,
                   const std::function<void(const ContactView&)>& in_order,
                   const std::function<void(const ContactView&)>& late) {
    ChunkMemory memory;
    const ForceInput in = with_screens(forces, contacts, nullptr, memory.screens);
    const ContactTable& table = contacts.tables[g];
    std::vector<MeshTouch> touch;
    if (in.rules.groups[g].of_mesh) touch = see_new_patches(in, g, contacts, memory, late);
    table.each_chunk([&](std::int32_t c, int count) {
        const std::int32_t *const first = table.first() + c, *const second = table.second() + c;
        const MeshTouch* const mesh = touch.empty() ? nullptr : touch.data() + c;
        see_chunk(in, in.rules.groups[g], {first, second, first, second, count, mesh},
                  table.histories().of_block(c), contacts.begin, memory,
                  c < table.sorted() ? in_order : late);
    });
    see_candidates(in, g, contacts, memory, late);
}

}  // namespace grainreel
