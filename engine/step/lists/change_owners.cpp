#include "engine/step/lists/change_owners.hpp"

#include <algorithm>
#include <utility>

namespace grainreel {

int owner_of(const Shares& shares, std::int32_t grain) {
    return static_cast<int>(std::upper_bound(shares.begin() + 1, shares.end() - 1, grain) -
                            (shares.begin() + 1));
}

void count_contacts(const ThreadContacts& contacts, const std::vector<std::int32_t>& index,
                    std::vector<std::int32_t>& count) {
    for (const ContactTable& table : contacts.tables) {
        table.each_stretch([&](std::int32_t begin, std::int32_t end) {
            for (std::int32_t c = begin; c < end; ++c) {
                const std::int32_t first = table.first()[c];
                if (table.touches(c) && contacts.owns(first)) ++count[index[first]];
            }
        });
    }
}

namespace {

// Flips the signs of those numbers of a history that change sign when the two bodies of a contact swap
// places.
void turn_history(const ContactGroup& group, Histories& histories, std::int32_t c) {
    for (int k = 0; k < group.history_size(); ++k) {
        if (group.turns(k)) histories.set(c, k, -histories.get(c, k));
    }
}

void renumber_group(const ContactGroup& group, int thread, const Renumbering& to, ContactTable& table,
                    KeptContacts& leaving) {
    const bool pairs = group.of_pairs;
    for (std::int32_t c = 0; c < table.size(); ++c) {
        if (!table.touches(c)) continue;
        const std::int32_t i = table.first()[c], j = table.second()[c];
        std::int32_t a = to.index[i], b = pairs ? to.index[j] : j;
        const int had = owner_of(to.before, i), had_too = pairs ? owner_of(to.before, j) : had;
        if (pairs && a > b) {
            std::swap(a, b);
            turn_history(group, table.histories(), c);
        }
        table.renumber(c, a, b);
        const int wants = owner_of(to.after, a), wants_too = pairs ? owner_of(to.after, b) : wants;
        if (had == thread) {  // two threads may have it; the owner of its first body hands it over
            const auto is_new = [&](int other) { return other != had && other != had_too; };
            if (is_new(wants)) table.keep(c, wants, leaving);
            if (wants_too != wants && is_new(wants_too)) table.keep(c, wants_too, leaving);
        }
        if (wants != thread && wants_too != thread) table.drop(c);
    }
    table.forget_order();
}

}  // namespace

void renumber(const ContactRules& rules, int thread, const Renumbering& to, ThreadContacts& contacts,
              std::vector<KeptContacts>& leaving) {
    leaving.resize(contacts.tables.size());
    for (std::size_t g = 0; g < leaving.size(); ++g) {
        leaving[g].clear();
        renumber_group(rules.groups[g], thread, to, contacts.tables[g], leaving[g]);
    }
}

void take(int thread, const std::vector<KeptContacts>& leaving, ThreadContacts& contacts) {
    for (std::size_t g = 0; g < leaving.size(); ++g) {
        for (std::size_t k = 0; k < leaving[g].size(); ++k)
            if (leaving[g].tag[k] == thread) contacts.tables[g].take(leaving[g], k);
    }
}

void leave_out(const ContactRules& rules, const std::vector<std::int32_t>& index, ThreadContacts& contacts) {
    for (std::size_t g = 0; g < contacts.tables.size(); ++g) {
        const bool pairs = rules.groups[g].of_pairs;
        ContactTable& table = contacts.tables[g];
        for (std::int32_t c = 0; c < table.size(); ++c) {
            if (!table.touches(c)) continue;
            const std::int32_t i = index[table.first()[c]];
            const std::int32_t j = pairs ? index[table.second()[c]] : table.second()[c];
            i == kGone || j == kGone ? table.drop(c) : table.renumber(c, i, j);
        }
    }
}

namespace {

void leave_out(NeighbourList& list, const std::vector<std::int32_t>& index) {
    std::size_t grains = 0, partners = 0;
    list.farthest_partner = 0;
    std::int32_t from = 0;
    for (std::size_t i = 0; i < index.size(); ++i) {
        const std::int32_t begin = std::exchange(from, list.start[i + 1]);
        if (index[i] == kGone) continue;
        for (std::int32_t at = begin; at < from; ++at) {
            const std::int32_t partner = index[list.partner[at]];
            if (partner == kGone) continue;
            list.farthest_partner = std::max(list.farthest_partner, partner - index[i]);
            list.partner[partners++] = partner;
        }
        list.start[++grains] = static_cast<std::int32_t>(partners);
    }
    list.start.resize(grains + 1);
    list.partner.resize(partners);
}

void leave_out(std::vector<WallNeighbour>& walls, const std::vector<std::int32_t>& index) {
    std::size_t kept = 0;
    for (const WallNeighbour& w : walls)
        if (index[w.grain] != kGone) walls[kept++] = {index[w.grain], w.face};
    walls.resize(kept);
}

}  // namespace

void leave_out(const std::vector<std::int32_t>& index, NeighbourLists& lists) {
    leave_out(lists.pairs, index);
    leave_out(lists.walls, index);
    leave_out(lists.glued, index);
    leave_out(lists.meshes, index);
}

}  // namespace grainreel
