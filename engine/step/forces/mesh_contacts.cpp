#include "engine/step/forces/mesh_contacts.hpp"

#include <algorithm>

namespace grainreel {

namespace {

// Keeps the fault of the earliest step, and in it that of the lowest id. Those of this step have no number
// yet.
void note(const MeshFault& fault, std::optional<MeshFault>& first) {
    if (!first || (first->step < 0 && fault.grain < first->grain)) first = fault;
}

// Rows and histories hold a block's numbers in the same way.
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
        // Rising numbers: patches come by rising triangle, and new ones take the lowest that is free.
        for (const MatchedPatch& patch : matcher.match(in, in.meshes, group, near, lists, table)) {
            std::int32_t c = near.contact[patch.number];
            if (c == MeshNear::kNone) {
                c = table.add_new(near.grain, near.mesh * kMostPatches + patch.number);
                near.set_contact(patch.number, c);
                lists.touch.resize(MeshLists::places_for(table.size()));
            } else if (!patch.goes_on) {
                table.histories().clear(c);
            }
            lists.touch[static_cast<std::size_t>(c)] = patch.touch;
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

}  // namespace grainreel
