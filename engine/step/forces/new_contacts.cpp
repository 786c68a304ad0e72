#include "engine/step/forces/new_contacts.hpp"

#include <bit>

namespace grainreel {

namespace {

// The candidates [from, to) of a group; `from` is a multiple of kChunk.
void admit_all(const ForceInput& in, std::size_t g, ThreadContacts& contacts, std::int32_t from,
               std::int32_t to) {
    const ContactGroup& group = in.rules.groups[g];
    ContactTable& table = contacts.tables[g];
    for (std::int32_t c = from; c < to; c += kChunk) {
        const auto bodies = contacts.found[g].candidates.of(table.near_first(), table.near_second(), c);
        if (group.of_pairs && is_large_bed(in.grains)) fetch_places(in.grains, table, c);
        table.admit(c, which_touch(in, group, bodies, std::min(kChunk, to - c)));
    }
}

// Lists the candidates of one stretch that are closer than `gap` (m).
void list_soon(const ForceInput& in, const ContactTable& table, const FoundPairs& candidates, SoonList& soon,
               double gap) {
    soon.begin(in.times.moved, gap);
    for (std::int32_t c = soon.from(); c < soon.to(); c += kChunk) {
        const int count = std::min(kChunk, soon.to() - c);
        const auto [first, second] = candidates.of(table.near_first(), table.near_second(), c);
        std::uint64_t left = near_pairs(in.grains, first, second, count, in.rules.period, gap);
        left &= bits_of_first(count) & ~table.admitted(c);
        if (!soon.has_room(std::popcount(left))) return soon.give_up();
        for (; left != 0; left &= left - 1) {
            const int k = std::countr_zero(left);
            soon.add(first[k], second[k], c + k);
        }
    }
    soon.end();
}

void admit_soon(const ForceInput& in, std::size_t g, ThreadContacts& contacts, const SoonList& soon) {
    if (soon.are_all()) return admit_all(in, g, contacts, soon.from(), soon.to());
    for (std::int32_t k = 0; k < soon.size(); k += kChunk) {
        const Halo::Bodies bodies{soon.first() + k, soon.second() + k};
        std::uint64_t left = which_touch(in, in.rules.groups[g], bodies, std::min(kChunk, soon.size() - k));
        for (; left != 0; left &= left - 1) {
            const std::int32_t at = soon.at(k + std::countr_zero(left));
            contacts.tables[g].admit(at / kChunk * kChunk, std::uint64_t{1} << at % kChunk);
        }
    }
}

// For pairs of a small bed. A large bed looks at all candidates: this brings their places to the cache, and
// contacts need them soon after. (With lists, contacts took 1.15 times as long there.)
//
// kShare is a compromise. A small gap holds few pairs; a large gap makes a list last longer.
void admit_soon(const ForceInput& in, std::size_t g, ThreadContacts& contacts) {
    constexpr double kShare = 1.0 / 10;
    contacts.soon[g].each(kShare * contacts.skin, [&](SoonList& soon, double gap) {
        if (!soon.lasts(in.times.moved))
            list_soon(in, contacts.tables[g], contacts.found[g].candidates, soon, gap);
        admit_soon(in, g, contacts, soon);
    });
}

}  // namespace

void add_new_contacts(const ForceInput& in, std::size_t g, ThreadContacts& contacts) {
    ContactTable& table = contacts.tables[g];
    table.begin_step();
    if (in.rules.groups[g].of_pairs && !is_large_bed(in.grains))
        admit_soon(in, g, contacts);
    else
        admit_all(in, g, contacts, 0, table.candidates());
    const std::int32_t first_new = table.end_step();
    contacts.note_loaded(in.rules, g, first_new, table.size());
}

}  // namespace grainreel
