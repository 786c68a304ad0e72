#include "engine/step/forces/mesh_contacts.hpp"

namespace grainreel {

namespace {

// Keeps the fault of the earliest step, and in it that of the lowest id. Those of this step have no number
// yet.
void note(const MeshFault& fault, std::optional<MeshFault>& first) {
    if (!first || (first->step < 0 && fault.grain < first->grain)) first = fault;
}

}  // namespace

void find_patches(const ForceInput& in, std::size_t g, ThreadContacts& contacts, PatchMatcher& matcher) {
    const ContactGroup& group = in.rules.groups[g];
    ContactTable& table = contacts.tables[g];
    MeshLists& lists = contacts.meshes[g];
    table.begin_step();
    lists.touch.assign(static_cast<std::size_t>(table.size()), {});
    for (MeshNear& near : lists.near) {
        // Rising numbers: patches come by rising triangle, and new ones take the lowest that is free.
        for (const MatchedPatch& patch : matcher.match(in, in.meshes, group, near, lists, table)) {
            std::int32_t& c = near.contact[patch.number];
            if (c == MeshNear::kNone) {
                c = table.add_new(near.grain, near.mesh * kMostPatches + patch.number);
                lists.touch.resize(static_cast<std::size_t>(table.size()));
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
    const std::size_t size = group.number_size();
    const int behind = group.law_size();
    for (int k = 0; k < count; ++k) {
        const bool touches = memory.touch.touches(k);
        const auto keep = [&](int number, double value) {
            histories.set(c + k, behind + number, touches ? value : 0.0);
        };
        keep(kTriangle, touch[k].triangle);
        for (int a = 0; a < 3; ++a) keep(kNormalX + a, memory.touch.normal[a].get(k, size));
        keep(kForce, memory.force.normal.get(k, size));
    }
}

}  // namespace grainreel
