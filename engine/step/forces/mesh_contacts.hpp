// Contacts with meshes, in each step: which patches a grain touches, and what their contacts remember.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/step/forces/law_input.hpp"
#include "engine/step/lists/thread_contacts.hpp"

namespace grainreel {

// Takes the place of add_new_contacts() for a group of meshes: finds the patches that grains touch, begins
// their contacts at the end of the table, and sets MeshLists::touch. Notes the first fault.
void find_patches(const ForceInput& in, std::size_t group, ThreadContacts& contacts, PatchMatcher& matcher);

// After the law of a chunk that begins at contact c: its contacts remember their patches.
void remember_patches(const ContactGroup& group, const MeshTouch* touch, const ChunkMemory& memory,
                      std::int32_t c, int count, Histories& histories);

}  // namespace grainreel
