// The candidates that have come to touch.
#pragma once

#include <algorithm>
#include <cstdint>

#include "engine/step/forces/law_input.hpp"
#include "engine/step/geometry/contact_geometry.hpp"
#include "engine/step/lists/large_bed.hpp"
#include "engine/step/lists/thread_contacts.hpp"

namespace grainreel {

// Once a step: candidates of a group that touch become contacts, at the end of its table.
void add_new_contacts(const ForceInput& in, std::size_t group, ThreadContacts& contacts);

// One bit for each of `count` candidates, at most kChunk: whether its bodies touch.
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

}  // namespace grainreel
