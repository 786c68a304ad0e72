// The forces of one step: new contacts, then each contact's geometry, law and load. view_contacts() shows
// contacts to observers in the same way. Hot: all but view_contacts() runs in each step.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "engine/step/contact_view.hpp"
#include "engine/step/forces/law_input.hpp"
#include "engine/step/geometry/contact_geometry.hpp"
#include "engine/step/lists/large_bed.hpp"
#include "engine/step/lists/thread_contacts.hpp"
#include "engine/step/motion/integrate.hpp"
#include "engine/step/threads/work_shares.hpp"

namespace grainreel {

// Grains that begin their next step while other grains still wait for forces.
//
// The data of these grains are still in the cache then, so each step reads the bed from memory once, not
// twice. No contact that is still to be computed may need such a grain, and no other thread may read it.
//
// What this gains: a rising bed of a million grains is some 1.07 times as fast, and a bed of 10,000 grains on
// two threads 1.02 to 1.03 times. A bed on one thread that fits into the cache gains nothing and would take
// up to 1.6 % more instructions, so its grains do not begin early (docs/notes/performance.md, "Three devices
// of the step").
struct Vanguard {
    std::int32_t next = 0,
                 end = 0;  // the grains [next, end) may begin their next step; the range may be empty
    KickInput kicks;
    Vec3 fastest{0, 0, 0};  // m/s, largest velocity components of the grains that have begun it
};

// Lets the grains below `complete` begin their next step. Up to kTogether - 1 of them stay back, so that
// grains are always taken kTogether at a time.
inline void advance(Vanguard& vanguard, Grains& grains, std::int32_t complete) {
    const std::int32_t many = complete - vanguard.next;
    const std::int32_t end = std::min(vanguard.next + many - many % kTogether, vanguard.end);
    if (end <= vanguard.next) return;
    vanguard.fastest = vanguard.fastest.cwiseMax(kick_and_go_on(grains, vanguard.kicks, vanguard.next, end));
    vanguard.next = end;
}

// Adds the forces of walls, then the forces of pairs, to the loads of the thread's own grains. Adds the work
// of moving walls to Grains::wall_work. `grains` are those of `in`. Grains of `vanguard` begin their next
// step as soon as their loads are complete.
void add_contact_forces(const ForceInput& in, Grains& grains, ThreadContacts& contacts, ChunkMemory& memory,
                        Vanguard& vanguard, CostClock& clock);

// Does for contacts with meshes what add_new_contacts() does for other groups. Finds the patches that grains
// touch, begins their contacts at the end of the table, and sets MeshLists::touch. It also notes the first
// fault.
void find_patches(const ForceInput& in, std::size_t group, ThreadContacts& contacts, PatchMatcher& matcher);

// Stores the patches in the histories of the chunk that begins at contact c. Call it after the chunk's law.
void remember_patches(const ContactGroup& group, const MeshTouch* touch, const ChunkMemory& memory,
                      std::int32_t c, int count, Histories& histories);

// Makes contacts of the candidates of a group that touch, at the end of its table. Call it once a step.
void add_new_contacts(const ForceInput& in, std::size_t group, ThreadContacts& contacts);

// Returns one bit for each of `count` candidates (at most kChunk), which says whether its bodies touch.
inline std::uint64_t which_touch(const ForceInput& in, const ContactGroup& group, const Halo::Bodies& bodies,
                                 int count) {
    const auto touching = [&] {
        if (group.of_pairs)
            return near_pairs(in.grains, bodies.first, bodies.second, count, in.rules.period, 0);
        if (group.of_glued)
            return touching_glued(in.grains, bodies.first, bodies.second, count,
                                  {in.glued, in.walls, in.rules.period});
        return touching_walls(in.grains, bodies.first, bodies.second, count, in.walls);
    };
    return touching() & bits_of_first(count);
}

// Shows observers every touching contact of a group whose first body is one of the thread's own grains.
// Contacts that began since the last refresh go to `late`. The others go to `in_order`, by rising first and
// second body. Which contacts go to `late` does not depend on the threads.
void view_contacts(const ForceInput& in, std::size_t group, const ThreadContacts& contacts,
                   const std::function<void(const ContactView&)>& in_order,
                   const std::function<void(const ContactView&)>& late);

}  // namespace grainreel
