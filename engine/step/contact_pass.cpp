#include "engine/step/contact_pass.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "engine/step/loads.hpp"

namespace grainreel {

namespace {

bool near(const Grains& grains, std::int32_t i, std::int32_t j, double period, double skin) {
    const Place &one = grains.place[i], &two = grains.place[j];
    Vec3 apart = two.position - one.position;
    apart.x() = nearest_image(apart.x(), period);
    const double limit = one.radius + two.radius + skin;
    return apart.squaredNorm() < limit * limit;
}

// Rows of the parameters, where contacts differ in them.
void note_kinds(ContactList& list, const Grains& grains, const ContactGroup& group, std::int32_t species) {
    list.kind.clear();
    if (!group.needs_rows()) return;
    for (std::size_t c = 0; c < list.first.size(); ++c) {
        const std::int32_t i = list.first[c], j = list.second[c];
        const std::int32_t kind =
            group.of_pairs ? grains.species[i] * species + grains.species[j] : grains.species[i];
        list.kind.push_back(group.row[kind]);
    }
}

// Where the wall neighbours of grains from `begin` on start in their list.
std::int32_t first_wall_slot(const std::vector<WallNeighbour>& list, std::int32_t begin) {
    const auto lower = [](const WallNeighbour& w, std::int32_t grain) { return w.grain < grain; };
    return static_cast<std::int32_t>(std::lower_bound(list.begin(), list.end(), begin, lower) - list.begin());
}

}  // namespace

void ContactPass::own(const ContactRules& rules, const NeighbourLists& lists, std::int32_t begin,
                      std::int32_t end) {
    begin_ = begin;
    end_ = end;
    incoming_.clear();
    const NeighbourList& list = lists.pairs;
    for (std::int32_t i = std::max(0, begin - list.farthest_partner); i < begin; ++i) {
        for (std::int32_t at = list.start[i]; at < list.start[i + 1]; ++at) {
            if (list.partner[at] >= begin && list.partner[at] < end)
                incoming_.push_back({i, list.partner[at]});
        }
    }
    const auto incoming = static_cast<std::int32_t>(incoming_.size());
    const std::int32_t pairs = incoming + list.start[end] - list.start[begin];
    const std::int32_t walls = first_wall_slot(lists.walls, end) - first_wall_slot(lists.walls, begin);
    lists_.resize(rules.groups.size());
    for (std::size_t g = 0; g < lists_.size(); ++g) {
        const ContactGroup& group = rules.groups[g];
        lists_[g].renumber(group.of_pairs ? pairs : walls, group.history_size(), group.number_size());
    }
}

// Slots count the pairs of earlier threads' grains first, then those under own grains.
void ContactPass::list_pairs_within(const ContactRules& rules, const Grains& grains,
                                    const NeighbourList& list, double skin) {
    const bool one_group = rules.one_group_of_pairs();
    std::int32_t slot = 0;
    const auto sort_in = [&](std::int32_t i, std::int32_t j) {
        const std::int32_t group =
            one_group ? 0 : rules.group_of_pair[grains.species[i] * rules.species + grains.species[j]];
        if (near(grains, i, j, rules.period, skin))
            lists_[group].add(slot, i, j);
        else
            lists_[group].leave(slot);
        ++slot;
    };
    for (const Pair& pair : incoming_) sort_in(pair.first, pair.second);
    for (std::int32_t i = begin_; i < end_; ++i) {
        for (std::int32_t at = list.start[i], last = list.start[i + 1]; at < last; ++at)
            sort_in(i, list.partner[at]);
    }
}

void ContactPass::list_walls_within(const ContactRules& rules, const Grains& grains,
                                    const std::vector<WallNeighbour>& list, const std::vector<Face>& faces,
                                    const Pose& pose, double skin) {
    const std::int32_t first = first_wall_slot(list, begin_), last = first_wall_slot(list, end_);
    for (std::int32_t at = first; at < last; ++at) {
        const auto [grain, face] = list[at];
        const Place& place = grains.place[grain];
        ContactList& of = lists_[rules.group_of_wall[grains.species[grain]]];
        const Vec3 moved = faces[face].displacement(pose);
        if (distance_to(faces[face], moved, place.position).distance < place.radius + skin)
            of.add(at - first, grain, face);
        else
            of.leave(at - first);
    }
}

void ContactPass::refresh(const ContactRules& rules, const Grains& grains, const NeighbourLists& lists,
                          const std::vector<Face>& faces, const Pose& pose, double skin) {
    for (ContactList& list : lists_) list.begin();
    list_pairs_within(rules, grains, lists.pairs, skin);
    list_walls_within(rules, grains, lists.walls, faces, pose, skin);
    for (std::size_t g = 0; g < lists_.size(); ++g) {
        lists_[g].end();
        note_kinds(lists_[g], grains, rules.groups[g], rules.species);
    }
}

void ContactPass::keep(std::vector<KeptContacts>& kept) const {
    kept.resize(lists_.size());
    for (std::size_t g = 0; g < lists_.size(); ++g) {
        kept[g].clear();
        lists_[g].keep(kept[g], begin_);
    }
}

void ContactPass::restore(const ContactRules& rules, std::size_t group, const KeptContacts& kept,
                          const std::vector<std::int32_t>& index) {
    const ContactGroup& of = rules.groups[group];
    const auto own = [&](std::int32_t grain) { return grain >= begin_ && grain < end_; };
    const int numbers = of.history_size();
    std::vector<double> turned(numbers);
    for (std::size_t k = 0; k < kept.size(); ++k) {
        std::int32_t i = index[kept.first[k]], j = of.of_pairs ? index[kept.second[k]] : kept.second[k];
        if (!own(i) && !(of.of_pairs && own(j))) continue;
        const double sign = of.of_pairs && i > j ? -1 : 1;
        if (sign < 0) std::swap(i, j);
        for (int h = 0; h < numbers; ++h) {
            const double value = kept.history[k * numbers + h];
            turned[h] = of.turns(h) ? sign * value : value;
        }
        // A contact not found has parted since the last step.
        lists_[group].restore(i, j, turned.data());
    }
}

// Whole registers are read: the last contact is repeated, but for its history.
void ContactPass::Chunk::fill_up() {
    for (int c = count; c % kBlock != 0; ++c) {
        first[c] = first[c - 1];
        second[c] = second[c - 1];
        kind[c] = kind[c - 1];
        row[c] = HistoryRows::kScratch;
    }
}

// Sets touch_ and history_ for the chunk; what its laws take.
LawInput ContactPass::prepare(const ContactRules& rules, std::size_t group, const Grains& grains,
                              const WallState& state, const Times& times) const {
    const ContactGroup& of = rules.groups[group];
    const HistoryRows& rows = lists_[group].rows();
    chunk_.fill_up();
    const GeometryInput in{&grains,
                           chunk_.first,
                           chunk_.second,
                           chunk_.count,
                           of.rolling ? Wants::rolling : wants_of(*of.law),
                           rules.arms,
                           times.since,
                           of.law->at_mid_step ? times.turns : 0,
                           &rolling_,
                           of.law->uses_mass,
                           of.law->uses_radius || of.rolling};
    of.of_pairs ? touch_pairs(in, rules.period, touch_) : touch_walls(in, state, touch_);
    if (chunk_.count < kChunk) touch_.touching &= (std::uint64_t{1} << chunk_.count) - 1;  // not the fill
    history_.shape(rows.chunk_numbers(), of.number_size());
    rows.bring(chunk_.row, chunk_.filled(), history_);
    return {chunk_.count,   &touch_,     touch_.effective_mass, touch_.effective_radius, chunk_.kind,
            &of.parameters, times.since, times.ahead,           rows.chunk_numbers(),    &rolling_};
}

namespace {

// The second law of a chunk starts behind the first in each block of the history.
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

// Packs what touches of a list into chunk_, and calls work() whenever that is full, and at the end.
template <class TouchingFrom, class Row, class Work>
void ContactPass::pack(const ContactList& list, const TouchingFrom& touching_from, const Row& row,
                       const Work& work) const {
    const std::int32_t *first = list.first.data(), *second = list.second.data();
    const std::int32_t* kind = list.kind.empty() ? nullptr : list.kind.data();
    Chunk& to = chunk_;
    int count = 0;
    for (std::int32_t begin = 0; begin < list.size(); begin += kChunk) {
        for (std::uint64_t left = touching_from(begin); left != 0; left &= left - 1) {
            const std::int32_t c = begin + std::countr_zero(left);
            to.first[count] = first[c];
            to.second[count] = second[c];
            to.kind[count] = kind ? kind[c] : 0;
            to.row[count] = row(c);
            if (++count < kChunk) continue;
            to.count = count;
            work();
            count = 0;
        }
    }
    to.count = count;
    work();
}

void ContactPass::compute(const ContactRules& rules, Grains& grains, const WallState& state,
                          const Times& times, CostClock& clock) {
    for (std::size_t g = 0; g < lists_.size(); ++g) {
        ContactList& list = lists_[g];
        const auto touching_from = [&](std::int32_t c) {
            const std::uint64_t touching = which_touch(rules, g, grains, state, c);
            list.note_touching(c, touching);
            return touching;
        };
        pack(
            list, touching_from, [&](std::int32_t c) { return list.row_to_write(c); },
            [&] { compute_chunk(rules, g, grains, state, times, clock); });
    }
}

void ContactPass::compute_chunk(const ContactRules& rules, std::size_t group, Grains& grains,
                                const WallState& state, const Times& times, CostClock& clock) {
    const ContactGroup& of = rules.groups[group];
    if (chunk_.count > 0) {
        const LawInput in = prepare(rules, group, grains, state, times);
        void* history = history_.of_block(0);
        of.law->step(in, history, force_);
        if (of.rolling) of.rolling->step(for_rolling(of, in), behind_law(of, history), force_);
        lists_[group].rows().put_back(chunk_.row, chunk_.filled(), history_);
    }
    clock.lap(of.of_pairs ? Cost::contacts : Cost::walls);
    if (chunk_.count > 0) {
        const ChunkOfContacts chunk{chunk_.first,
                                    chunk_.second,
                                    chunk_.count,
                                    &touch_,
                                    &force_,
                                    of.law->rubs,
                                    of.rolling ? &rolling_ : nullptr};
        of.of_pairs ? add_pairs(chunk, loads_, begin_, end_, grains)
                    : add_walls(chunk, loads_, state, times.acts, grains);
    }
    clock.lap(of.of_pairs ? Cost::gather : Cost::walls);
}

std::uint64_t ContactPass::which_touch(const ContactRules& rules, std::size_t group, const Grains& grains,
                                       const WallState& state, std::int32_t c) const {
    const ContactList& list = lists_[group];
    const int count = std::min(kChunk, list.size() - c);
    const std::int32_t *first = list.first.data() + c, *second = list.second.data() + c;
    const std::uint64_t touching = rules.groups[group].of_pairs
                                       ? touching_pairs(grains, first, second, count, rules.period)
                                       : touching_walls(grains, first, second, count, state);
    return count < kChunk ? touching & ((std::uint64_t{1} << count) - 1) : touching;
}

void ContactPass::observe(const ContactRules& rules, std::size_t group, const Grains& grains,
                          const WallState& state, const Seen& seen) const {
    const ContactGroup& of = rules.groups[group];
    const ContactList& list = lists_[group];
    const auto look = [&] {
        if (chunk_.count == 0) return;
        const LawInput in = prepare(rules, group, grains, state, {0, 0, 0, 0});
        const void* history = history_.of_block(0);
        EnergyChunk energy;
        of.law->observe(in, history, force_, energy);
        if (of.rolling) of.rolling->observe(for_rolling(of, in), behind_law(of, history), force_, energy);
        for (int k = 0; k < in.count; ++k) {
            if ((touch_.touching >> k & 1) && chunk_.first[k] >= begin_)
                seen(chunk_.first[k], chunk_.second[k], k, touch_, force_, energy);
        }
    };
    pack(
        list, [&](std::int32_t c) { return which_touch(rules, group, grains, state, c); },
        [&](std::int32_t c) { return list.row(c); }, look);
}

}  // namespace grainreel
