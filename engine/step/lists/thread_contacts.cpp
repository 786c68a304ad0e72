#include "engine/step/lists/thread_contacts.hpp"

#include <algorithm>
#include <bit>

namespace grainreel {

void ThreadContacts::own(const ContactRules& rules, const NeighbourLists& lists, std::int32_t first_own,
                         std::int32_t end_own) {
    begin = first_own;
    end = end_own;
    incoming.clear();
    const NeighbourList& list = lists.pairs;
    halo.own(begin, end, list.farthest_partner, static_cast<std::int32_t>(list.start.size()) - 1);
    for (std::int32_t i = std::max(0, begin - list.farthest_partner); i < begin; ++i) {
        for (std::int32_t at = list.start[i]; at < list.start[i + 1]; ++at) {
            if (!owns(list.partner[at])) continue;
            incoming.push_back({i, list.partner[at]});
            halo.need(i);
        }
    }
    for (std::int32_t i = std::max(begin, end - list.farthest_partner); i < end; ++i)
        for (std::int32_t at = list.start[i]; at < list.start[i + 1]; ++at) halo.need(list.partner[at]);
    if (tables.size() == rules.groups.size()) return;
    tables.resize(rules.groups.size());
    found.resize(rules.groups.size());
    soon.resize(rules.groups.size());
    meshes.resize(rules.groups.size());
    for (std::size_t g = 0; g < tables.size(); ++g)
        tables[g].shape(rules.groups[g].history_size(), rules.groups[g].number_size());
}

void ThreadContacts::list_foreign(const ContactRules& rules, Grains& grains, const Shares& shares) {
    halo.begin_list();
    for (std::size_t g = 0; g < tables.size(); ++g) {
        const ContactTable& table = tables[g];
        if (!rules.groups[g].of_pairs) continue;
        table.each_stretch([&](std::int32_t from, std::int32_t to) {
            halo.need(table.first() + from, table.second() + from, to - from);
        });
        halo.need(table.near_first(), table.near_second(), table.candidates());
    }
    halo.end_list(grains, shares);
    for (std::size_t g = 0; g < tables.size(); ++g) {
        const ContactTable& table = tables[g];
        if (!rules.groups[g].of_pairs) continue;
        found[g].contacts.set(halo, table.first(), table.second(), table.sorted());
        found[g].candidates.set(halo, table.near_first(), table.near_second(), table.candidates());
    }
}

Halo::Bodies ThreadContacts::bodies_of(const ContactRules& rules, std::size_t g, std::int32_t c, int count) {
    const ContactTable& table = tables[g];
    if (c < table.sorted()) return found[g].contacts.of(table.first(), table.second(), c);
    const Halo::Bodies listed{table.first() + c, table.second() + c};
    return rules.groups[g].of_pairs ? halo.find(listed.first, listed.second, count) : listed;
}

void ThreadContacts::note_loaded(const ContactRules& rules) {
    loaded.clear(begin, end);
    for (std::size_t g = 0; g < tables.size(); ++g)
        tables[g].each_stretch([&](std::int32_t from, std::int32_t to) { note_loaded(rules, g, from, to); });
}

void ThreadContacts::note_loaded(const ContactRules& rules, std::size_t g, std::int32_t from,
                                 std::int32_t to) {
    const ContactTable& table = tables[g];
    const bool of_pairs = rules.groups[g].of_pairs;
    for (std::int32_t c = from; c < to; ++c) {
        loaded.note(table.first()[c]);
        if (of_pairs) loaded.note(table.second()[c]);
    }
}

std::int64_t ThreadContacts::parted() const {
    std::int64_t count = 0;
    for (const ContactTable& table : tables) {
        table.each_stretch([&](std::int32_t from, std::int32_t to) {
            for (std::int32_t c = from; c < to; c += kChunk) {
                const std::uint64_t all = ~table.touching(c) & bits_of_first(to - c);
                if (begin == 0) count += std::popcount(all);
                for (std::uint64_t left = begin == 0 ? 0 : all; left != 0; left &= left - 1)
                    count += table.first()[c + std::countr_zero(left)] >= begin;
            }
        });
    }
    return count;
}

void ThreadContacts::keep(std::vector<KeptContacts>& kept) const {
    kept.resize(tables.size());
    for (std::size_t g = 0; g < tables.size(); ++g) {
        const ContactTable& table = tables[g];
        kept[g].clear();
        table.each_stretch([&](std::int32_t from, std::int32_t to) {
            for (std::int32_t c = from; c < to; ++c)
                if (table.first()[c] >= begin) table.keep(c, table.age(c), kept[g]);
        });
    }
}

void ThreadContacts::restore(const ContactRules& rules, const std::vector<KeptContacts>& kept,
                             std::int32_t steps) {
    for (std::size_t g = 0; g < tables.size(); ++g) {
        for (std::size_t k = 0; k < kept[g].size(); ++k) {
            if (owns(kept[g].first[k]) || (rules.groups[g].of_pairs && owns(kept[g].second[k])))
                tables[g].restore(kept[g], k);
        }
        tables[g].end_restore(steps);
    }
    note_loaded(rules);
}

}  // namespace grainreel
