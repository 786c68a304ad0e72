// Whether lists that come from a file are such as the step loop makes. Who reads them relies on it: an index
// out of its range would reach anywhere.
#pragma once

#include "engine/state/grains.hpp"
#include "engine/step/grid/neighbours.hpp"
#include "engine/step/lists/contact_rules.hpp"
#include "engine/step/lists/contact_table.hpp"

namespace grainreel {

// Every index in its range and in its order, and partners no farther than the list says.
bool are_sound(const NeighbourLists& lists, std::int32_t grains, std::int32_t faces);

// Contacts of the g-th group: bodies that there are and that follow its law, in the order in which they are
// computed; tags are ages, of at most `steps`.
bool are_sound(const KeptContacts& kept, const ContactRules& rules, std::size_t g, const Grains& grains,
               std::int32_t faces, std::int32_t steps);

// Where a contact stands in that order.
struct ContactOrder {
    std::int32_t began, first, second;
    auto operator<=>(const ContactOrder&) const = default;
};
ContactOrder order_of(const KeptContacts& kept, std::size_t c);

}  // namespace grainreel
