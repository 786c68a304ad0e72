#include "engine/step/forces/contact_pass.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <type_traits>

#include "engine/step/grid/large_bed.hpp"

namespace grainreel {

// Computes the geometry of the chunk into touch_, in floats if `rounded`. Returns the input of its law.
LawInput ContactPass::prepare(const ContactRules& rules, const ContactGroup& group, const Grains& grains,
                              const WallState& state, const Passed& passed, const Chunk& chunk,
                              const Halo::Bodies& bodies, bool rounded) const {
    const GeometryInput in{&grains,
                           bodies.first,
                           bodies.second,
                           chunk.count,
                           group.rolling ? Wants::rolling : wants_of(*group.law),
                           rules.arms,
                           passed.since,
                           group.law->at_mid_step ? passed.turns : 0,
                           &rolling_,
                           group.law->uses_mass,
                           group.law->uses_radius || group.rolling,
                           rounded};
    group.of_pairs ? touch_pairs(in, rules.period, touch_) : touch_walls(in, state, touch_);
    touch_.touching &= bits_of_first(chunk.count);  // without the copies that fill the last block
    return {chunk.count,          &touch_,      kinds_of(rules, group, grains, chunk),
            &group.parameters,    passed.since, passed.ahead,
            group.history_size(), &rolling_};
}

// The kind of each contact of a chunk, and of the copies that fill it.
const std::int32_t* ContactPass::kinds_of(const ContactRules& rules, const ContactGroup& group,
                                          const Grains& grains, const Chunk& chunk) const {
    static constexpr std::int32_t kOne[kChunk] = {};
    if (!group.needs_rows()) return kOne;
    for (int c = 0; c < chunk.count; ++c) {
        const std::int32_t one = grains.species[chunk.first[c]];
        kind_[c] = group.row[group.of_pairs ? one * rules.species + grains.species[chunk.second[c]] : one];
    }
    std::fill_n(kind_ + chunk.count, kChunk - chunk.count, 0);
    return kind_;
}

namespace {

// Resistance to rolling is the second law of a chunk. In each block of the history its numbers stand behind
// those of the first law.
LawInput for_rolling(const ContactGroup& group, LawInput in) {
    in.parameters = &group.rolling_parameters;
    return in;
}
template <class History>
History* behind_law(const ContactGroup& group, History* history) {
    using Bytes = std::conditional_t<std::is_const_v<History>, const std::byte, std::byte>;
    return static_cast<Bytes*>(history) + kBlock * group.number_size() * group.law->history_size;
}

}  // namespace

std::uint64_t ContactPass::which_touch(const ContactRules& rules, const ContactGroup& group,
                                       const Grains& grains, const WallState& state, const Chunk& chunk) {
    const std::uint64_t touching =
        group.of_pairs ? near_pairs(grains, chunk.first, chunk.second, chunk.count, rules.period, 0)
                       : touching_walls(grains, chunk.first, chunk.second, chunk.count, state);
    return touching & bits_of_first(chunk.count);
}

// Calls work(c, bits) for each 64 of the candidates [from, to): the bits say which of the candidates from c
// on touch. `from` is a multiple of 64.
template <class Work>
void ContactPass::each_touching_candidate(const ContactRules& rules, const ContactGroup& group,
                                          const ContactTable& table, std::int32_t from, std::int32_t to,
                                          const Grains& grains, const WallState& state,
                                          const FoundPairs* found, const Work& work) {
    for (std::int32_t c = from; c < to; c += kChunk) {
        Chunk chunk{table.near_first() + c, table.near_second() + c, std::min(kChunk, to - c)};
        if (found) {
            const auto [first, second] = found->of(table.near_first(), table.near_second(), c);
            chunk.first = first, chunk.second = second;
        }
        if (group.of_pairs && is_large_bed(grains)) fetch_places(grains, table, c);
        work(c, which_touch(rules, group, grains, state, chunk));
    }
}

void ContactPass::admit_all(const Step& in, ContactTable& table, std::int32_t from, std::int32_t to) {
    each_touching_candidate(in.rules, in.group, table, from, to, in.grains, in.walls,
                            &found_[in.g].candidates,
                            [&](std::int32_t c, std::uint64_t touching) { table.admit(c, touching); });
}

// For pairs of a small bed. A large bed looks at all candidates: this brings their places to the cache, and
// contacts need them soon after. (With lists, contacts took 1.15 times as long there.)
//
// kShare is a compromise. A small gap holds few pairs; a large gap makes a list last longer.
void ContactPass::admit_soon(const Step& in, ContactTable& table) {
    constexpr double kShare = 1.0 / 10;
    soon_[in.g].each(kShare * skin_, [&](SoonList& soon, double gap) {
        if (!soon.lasts(in.passed.moved)) list_soon(in, table, soon, gap);
        admit_soon(in, table, soon);
    });
}

void ContactPass::admit_soon(const Step& in, ContactTable& table, const SoonList& soon) {
    if (soon.are_all()) return admit_all(in, table, soon.from(), soon.to());
    for (std::int32_t k = 0; k < soon.size(); k += kChunk) {
        const Chunk chunk{soon.first() + k, soon.second() + k, std::min(kChunk, soon.size() - k)};
        std::uint64_t left = which_touch(in.rules, in.group, in.grains, in.walls, chunk);
        for (; left != 0; left &= left - 1) {
            const std::int32_t at = soon.at(k + std::countr_zero(left));
            table.admit(at / kChunk * kChunk, std::uint64_t{1} << at % kChunk);
        }
    }
}

void ContactPass::list_soon(const Step& in, const ContactTable& table, SoonList& soon, double gap) {
    soon.begin(in.passed.moved, gap);
    for (std::int32_t c = soon.from(); c < soon.to(); c += kChunk) {
        const int count = std::min(kChunk, soon.to() - c);
        const auto [first, second] = found_[in.g].candidates.of(table.near_first(), table.near_second(), c);
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

void ContactPass::compute(const ContactRules& rules, Grains& grains, const WallState& state,
                          const Passed& passed, Vanguard& vanguard, CostClock& clock) {
    for (std::size_t g = tables_.size(); g-- > 0;) {
        ContactTable& table = tables_[g];
        const Step in{rules, g, rules.groups[g], grains, state, passed};
        table.begin_step();
        in.group.of_pairs && !is_large_bed(grains) ? admit_soon(in, table)
                                                   : admit_all(in, table, 0, table.candidates());
        note_loaded(in.group.of_pairs, table, table.end_step(), table.size());
        compute_stretch(in, table, table.late(), table.size(), nullptr, clock);
        compute_stretch(in, table, 0, table.sorted(), g == 0 ? &vanguard : nullptr, clock);
    }
    advance(vanguard, grains, end_);
    clock.lap(Cost::integrate);
}

void ContactPass::compute_stretch(const Step& in, ContactTable& table, std::int32_t begin, std::int32_t end,
                                  Vanguard* vanguard, CostClock& clock) {
    for (std::int32_t c = begin; c < end; c += kChunk) {
        const int count = std::min(kChunk, end - c);
        compute_chunk(in, table, c, count, clock);
        if (!vanguard || c + count == end) continue;
        advance(*vanguard, in.grains, table.first()[c + count]);
        clock.lap(Cost::integrate);
    }
}

// Where to read the bodies of `count` contacts from c on.
Halo::Bodies ContactPass::bodies_of(std::size_t g, const ContactGroup& group, std::int32_t c, int count) {
    const ContactTable& table = tables_[g];
    if (c < table.sorted()) return found_[g].contacts.of(table.first(), table.second(), c);
    const Halo::Bodies listed{table.first() + c, table.second() + c};
    return group.of_pairs ? halo_.find(listed.first, listed.second, count) : listed;
}

void ContactPass::compute_chunk(const Step& in, ContactTable& table, std::int32_t c, int count,
                                CostClock& clock) {
    const ContactGroup& group = in.group;
    const Chunk chunk{table.first() + c, table.second() + c, count};
    const bool rounded = group.number_size() == sizeof(float);
    const bool large = group.of_pairs && c < table.sorted() && is_large_bed(in.grains);
    touch_.ahead = large ? &ahead_ : nullptr;
    if (large) look_ahead(in.grains, rounded, table, c, count, ahead_);
    const Halo::Bodies bodies = bodies_of(in.g, group, c, count);
    const LawInput law = prepare(in.rules, group, in.grains, in.walls, in.passed, chunk, bodies, rounded);
    table.note_touching(c, touch_.touching);
    void* history = table.histories().of_block(c);
    // From here to the formula: step_any() and step_chunk() (engine/laws/kernel-inl.hpp) load a register of
    // contacts, ContactLaw::force() (contact_law-inl.hpp) joins the two laws, and their force() is the
    // formula: SpringDashpot::force() (spring_dashpot-inl.hpp), LinearSpring::force() (linear_spring-inl.hpp)
    // and so on.
    group.law->step(law, history, force_);
    if (group.rolling) group.rolling->step(for_rolling(group, law), behind_law(group, history), force_);
    clock.lap(group.of_pairs ? Cost::contacts : Cost::walls);
    const ChunkOfContacts forces{bodies.first,
                                 bodies.second,
                                 chunk.count,
                                 &touch_,
                                 &force_,
                                 group.law->rubs,
                                 group.rolling ? &rolling_ : nullptr,
                                 rounded,
                                 c < table.sorted()};
    group.of_pairs ? add_pairs(forces, in.grains) : add_walls({forces, in.walls, in.passed.acts, in.grains});
    clock.lap(group.of_pairs ? Cost::gather : Cost::walls);
}

void ContactPass::show(const ContactGroup& group, const LawInput& in, const void* history, const Chunk& chunk,
                       bool late, const Seen& seen) const {
    EnergyChunk energy;
    group.law->observe(in, history, force_, energy);
    if (group.rolling)
        group.rolling->observe(for_rolling(group, in), behind_law(group, history), force_, energy);
    for (int k = 0; k < chunk.count; ++k) {
        if ((touch_.touching >> k & 1) && chunk.first[k] >= begin_)
            seen(chunk.first[k], chunk.second[k], late, k, touch_, force_, energy);
    }
}

void ContactPass::observe(const ContactRules& rules, std::size_t g, const Grains& grains,
                          const WallState& state, const Seen& seen) const {
    const ContactGroup& group = rules.groups[g];
    const ContactTable& table = tables_[g];
    table.each_stretch([&](std::int32_t begin, std::int32_t end) {
        for (std::int32_t c = begin; c < end; c += kChunk) {
            const Chunk chunk{table.first() + c, table.second() + c, std::min(kChunk, end - c)};
            const LawInput in = prepare(rules, group, grains, state, {0, 0, 0, 0, 0}, chunk,
                                        {chunk.first, chunk.second}, false);
            show(group, in, table.histories().of_block(c), chunk, begin > 0, seen);
        }
    });
    // Positions may have moved on since the forces. So some candidates may touch that have no contact yet.
    Histories none;
    none.shape(group.history_size(), group.number_size());
    none.resize(kBlock);
    each_touching_candidate(
        rules, group, table, 0, table.candidates(), grains, state, nullptr,
        [&](std::int32_t c, std::uint64_t touching) {
            for (std::uint64_t left = touching & ~table.admitted(c); left != 0; left &= left - 1) {
                std::int32_t first[kBlock], second[kBlock];
                std::fill_n(first, kBlock, table.near_first()[c + std::countr_zero(left)]);
                std::fill_n(second, kBlock, table.near_second()[c + std::countr_zero(left)]);
                const Chunk chunk{first, second, 1};
                show(group,
                     prepare(rules, group, grains, state, {0, 0, 0, 0, 0}, chunk, {chunk.first, chunk.second},
                             false),
                     none.of_block(0), chunk, true, seen);
            }
        });
}

}  // namespace grainreel
