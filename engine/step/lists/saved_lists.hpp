// Whether lists from a file could have been made by the step loop. The code that reads lists relies on it: an
// index out of its range would read or write anywhere.
#pragma once

#include <vector>

#include "engine/base/binary.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/grid/neighbours.hpp"
#include "engine/step/lists/contact_rules.hpp"
#include "engine/step/lists/contact_table.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

// The numbers of wall parts.
struct WallParts {
    std::int32_t faces, glued;
    std::vector<std::int32_t> triangles = {};  // one for each mesh

    std::int32_t meshes() const { return static_cast<std::int32_t>(triangles.size()); }
};
WallParts parts_of(const Surroundings& around);

constexpr std::int32_t kMostStepsOfLists =
    1'000'000'000;  // bound for steps without a refresh, even of a bed at rest

// Every index must be in its range and in its order, and no partner may be farther away than farthest_partner
// says.
bool are_sound(const NeighbourLists& lists, std::int32_t grains, const WallParts& walls);

// Checks contacts of the g-th group. Their bodies must exist and follow the group's law, and the contacts
// must be in the order in which they are computed. Their tags are ages of at most `steps`.
bool are_sound(const KeptContacts& kept, const ContactRules& rules, std::size_t g, const Grains& grains,
               const WallParts& walls, std::int32_t steps);

// Reads the contacts that BedLists::save() writes first, group by group. Reading fails for anything that
// cannot have been written for these grains.
std::vector<KeptContacts> read_contacts(Bytes& in, const ContactRules& rules, const Grains& grains,
                                        const WallParts& walls);

// The key by which the contacts of a group are ordered.
struct ContactOrder {
    std::int32_t began, first, second;
    auto operator<=>(const ContactOrder&) const = default;
};
ContactOrder order_of(const KeptContacts& kept, std::size_t c);

}  // namespace grainreel
