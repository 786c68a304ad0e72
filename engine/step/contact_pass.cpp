#include "engine/step/contact_pass.hpp"

#include <algorithm>
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

// Rows of the parameters, effective masses and radii, as far as the group's laws ask for them.
void note_kinds(ContactList& list, const Grains& grains, const ContactGroup& group, std::int32_t species) {
    if (!group.needs_rows() && !group.needs_mass_or_radius()) return;
    for (std::int32_t c = 0; c < list.filled(); ++c) {
        const std::int32_t i = list.first[c], j = list.second[c];
        const std::int32_t kind =
            group.of_pairs ? grains.species[i] * species + grains.species[j] : grains.species[i];
        list.kind[c] = group.row[kind];
        if (!group.needs_mass_or_radius()) continue;
        double mass = grains.motion[i].inverse_mass, curvature = 1 / grains.place[i].radius;
        if (group.of_pairs) mass += grains.motion[j].inverse_mass, curvature += 1 / grains.place[j].radius;
        list.set_effective(c, 1 / mass, 1 / curvature);
    }
}

void add_near_walls(const ContactRules& rules, std::vector<ContactList>& lists, const Grains& grains,
                    const std::vector<WallNeighbour>& list, const std::vector<Face>& faces, const Pose& pose,
                    double skin, std::int32_t begin, std::int32_t end) {
    const auto lower = [](const WallNeighbour& w, std::int32_t grain) { return w.grain < grain; };
    std::size_t slot = std::lower_bound(list.begin(), list.end(), begin, lower) - list.begin();
    for (; slot < list.size() && list[slot].grain < end; ++slot) {
        const std::int32_t grain = list[slot].grain;
        const Place& place = grains.place[grain];
        const Face& face = faces[list[slot].face];
        if (distance_to(face, face.displacement(pose), place.position).distance < place.radius + skin) {
            lists[rules.group_of_wall[grains.species[grain]]].add(static_cast<std::int32_t>(slot), grain,
                                                                  list[slot].face);
        }
    }
}

}  // namespace

void ContactPass::own(const NeighbourLists& lists, std::int32_t begin, std::int32_t end) {
    begin_ = begin;
    end_ = end;
    incoming_.clear();
    const NeighbourList& list = lists.pairs;
    for (std::int32_t i = std::max(0, begin - list.farthest_partner); i < begin; ++i) {
        for (std::int32_t slot = list.start[i]; slot < list.start[i + 1]; ++slot) {
            if (list.partner[slot] >= begin && list.partner[slot] < end) incoming_.push_back({slot, i});
        }
    }
}

void ContactPass::add_pairs_within(const ContactRules& rules, const Grains& grains, const NeighbourList& list,
                                   double skin) {
    const bool one_group = rules.one_group_of_pairs();
    const auto add = [&](std::int32_t slot, std::int32_t i, std::int32_t j) {
        if (!near(grains, i, j, rules.period, skin)) return;
        const std::int32_t group =
            one_group ? 0 : rules.group_of_pair[grains.species[i] * rules.species + grains.species[j]];
        lists_[group].add(slot, i, j);
    };
    for (const auto& [slot, i] : incoming_) add(slot, i, list.partner[slot]);
    for (std::int32_t i = begin_; i < end_; ++i) {
        for (std::int32_t slot = list.start[i], last = list.start[i + 1]; slot < last; ++slot)
            add(slot, i, list.partner[slot]);
    }
}

void ContactPass::refresh(const ContactRules& rules, const Grains& grains, const NeighbourLists& lists,
                          const std::vector<Face>& faces, const Pose& pose, double skin,
                          bool carry_histories) {
    lists_.resize(rules.groups.size());
    for (ContactList& list : lists_) list.begin();
    add_pairs_within(rules, grains, lists.pairs, skin);
    add_near_walls(rules, lists_, grains, lists.walls, faces, pose, skin, begin_, end_);
    for (std::size_t g = 0; g < lists_.size(); ++g) {
        lists_[g].end(carry_histories, rules.groups[g].history_size(), rules.groups[g].number_size());
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

// Sets touch_ for a chunk after the other and calls law(input, number of the chunk's first contact).
template <class Law>
void ContactPass::each_chunk(const ContactRules& rules, std::size_t group, const Grains& grains,
                             const WallState& state, const Times& times, const Law& law) const {
    const ContactGroup& of = rules.groups[group];
    const ContactList& list = lists_[group];
    const Wants wants = of.rolling ? Wants::rolling : wants_of(*of.law);
    for (std::int32_t c = 0; c < list.size(); c += kChunk) {
        const int count = std::min(kChunk, list.size() - c);
        const GeometryInput in{&grains,
                               list.first.data() + c,
                               list.second.data() + c,
                               count,
                               wants,
                               rules.arms,
                               times.since,
                               of.law->at_mid_step ? times.turns : 0,
                               &rolling_};
        of.of_pairs ? touch_pairs(in, rules.period, touch_) : touch_walls(in, state, touch_);
        if (count < kChunk) touch_.touching &= (std::uint64_t{1} << count) - 1;  // not the fill
        law(LawInput{count, &touch_, list.mass_of_block(c), list.radius_of_block(c), list.kind.data() + c,
                     &of.parameters, times.since, times.ahead, of.history_size(), &rolling_},
            c);
    }
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

void ContactPass::compute(const ContactRules& rules, Grains& grains, const WallState& state,
                          const Times& times, CostClock& clock) {
    for (std::size_t g = 0; g < lists_.size(); ++g) {
        const ContactGroup& group = rules.groups[g];
        ContactList& list = lists_[g];
        each_chunk(rules, g, grains, state, times, [&](const LawInput& in, std::int32_t c) {
            void* history = list.history_of_block(c);
            group.law->step(in, history, force_);
            if (group.rolling)
                group.rolling->step(for_rolling(group, in), behind_law(group, history), force_);
            clock.lap(group.of_pairs ? Cost::contacts : Cost::walls);
            const ChunkOfContacts chunk{list.first.data() + c,
                                        list.second.data() + c,
                                        in.count,
                                        &touch_,
                                        &force_,
                                        group.law->rubs,
                                        group.rolling ? &rolling_ : nullptr};
            group.of_pairs ? add_pairs(chunk, loads_, begin_, end_, grains)
                           : add_walls(chunk, loads_, state, times.acts, grains);
            clock.lap(group.of_pairs ? Cost::gather : Cost::walls);
        });
    }
}

void ContactPass::observe(const ContactRules& rules, std::size_t group, const Grains& grains,
                          const WallState& state, const Seen& seen) const {
    const ContactGroup& of = rules.groups[group];
    const ContactList& list = lists_[group];
    each_chunk(rules, group, grains, state, {0, 0, 0, 0}, [&](const LawInput& in, std::int32_t c) {
        const void* history = list.history_of_block(c);
        EnergyChunk energy;
        of.law->observe(in, history, force_, energy);
        if (of.rolling) of.rolling->observe(for_rolling(of, in), behind_law(of, history), force_, energy);
        for (int k = 0; k < in.count; ++k) {
            if ((touch_.touching >> k & 1) && list.first[c + k] >= begin_)
                seen(list.first[c + k], list.second[c + k], k, touch_, force_, energy);
        }
    });
}

}  // namespace grainreel
