// The refresh of the contact lists, every 48 steps or so: contacts that have parted are dropped, the others
// are sorted, and pairs that may touch soon become candidates.
#pragma once

#include <vector>

#include "engine/state/glued_grains.hpp"
#include "engine/step/lists/thread_contacts.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

// The input from which candidates are listed: the neighbour lists of ThreadContacts::own(), and the walls at
// a pose.
struct Nearby {
    const Grains& grains;
    const NeighbourLists& lists;
    const std::vector<Face>& faces;
    const GluedGrains& glued;
    const std::vector<MeshWall>& meshes;
    const DrivePose& pose;
    double skin;  // m; pairs that are closer than this become candidates
};

void refresh(const ContactRules& rules, const Nearby& nearby, ThreadContacts& contacts);
// Lists candidates as refresh() does, but leaves the contacts as they are.
void list_candidates(const ContactRules& rules, const Nearby& nearby, ThreadContacts& contacts);

}  // namespace grainreel
