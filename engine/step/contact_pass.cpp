#include "engine/step/contact_pass.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "engine/step/large_bed.hpp"

namespace grainreel {

namespace {

std::uint64_t bits_of_first(int count) {
    return count < kChunk ? (std::uint64_t{1} << count) - 1 : ~std::uint64_t{0};
}

// Collects pairs until there is a chunk of them, and passes on those closer than `gap` (m).
template <class Pass>
class NearPairs {
  public:
    NearPairs(const Grains& grains, double period, double gap, const Pass& pass)
        : grains_(grains), period_(period), gap_(gap), pass_(pass) {}
    void add(std::int32_t i, std::int32_t j) {
        first_[count_] = i, second_[count_] = j;
        if (++count_ == kChunk) flush();
    }
    void flush() {
        // Up to a whole register, with what this thread may read.
        for (int k = count_; k > 0 && k % kBlock != 0; ++k)
            first_[k] = first_[k - 1], second_[k] = second_[k - 1];
        std::uint64_t left = near_pairs(grains_, first_, second_, count_, period_, gap_);
        left &= bits_of_first(count_);
        for (; left != 0; left &= left - 1) {
            const int k = std::countr_zero(left);
            pass_(first_[k], second_[k]);
        }
        count_ = 0;
    }

  private:
    const Grains& grains_;
    const double period_, gap_;
    const Pass& pass_;
    std::int32_t first_[kChunk] = {}, second_[kChunk] = {};
    int count_ = 0;
};

// Where the wall neighbours of grains from `begin` on start in their list.
std::int32_t first_wall_slot(const std::vector<WallNeighbour>& list, std::int32_t begin) {
    const auto lower = [](const WallNeighbour& w, std::int32_t grain) { return w.grain < grain; };
    return static_cast<std::int32_t>(std::lower_bound(list.begin(), list.end(), begin, lower) - list.begin());
}

// Of a contact whose bodies change places.
void turn_history(const ContactGroup& group, Histories& histories, std::int32_t c) {
    for (int k = 0; k < group.history_size(); ++k) {
        if (group.turns(k)) histories.set(c, k, -histories.get(c, k));
    }
}

}  // namespace

int owner_of(const Shares& shares, std::int32_t grain) {
    return static_cast<int>(std::upper_bound(shares.begin() + 1, shares.end() - 1, grain) -
                            (shares.begin() + 1));
}

void ContactPass::renumber(const ContactRules& rules, int member, const Renumbering& to,
                           std::vector<KeptContacts>& leaving) {
    leaving.resize(tables_.size());
    for (std::size_t g = 0; g < tables_.size(); ++g) {
        leaving[g].clear();
        renumber_group(rules.groups[g], member, to, tables_[g], leaving[g]);
    }
}

void ContactPass::renumber_group(const ContactGroup& group, int member, const Renumbering& to,
                                 ContactTable& table, KeptContacts& leaving) {
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
        if (had == member) {  // of the two threads that had it, this one hands it over
            const auto is_new = [&](int thread) { return thread != had && thread != had_too; };
            if (is_new(wants)) table.keep(c, wants, leaving);
            if (wants_too != wants && is_new(wants_too)) table.keep(c, wants_too, leaving);
        }
        if (wants != member && wants_too != member) table.drop(c);
    }
    table.forget_order();
}

void ContactPass::take(int member, const std::vector<KeptContacts>& leaving) {
    for (std::size_t g = 0; g < leaving.size(); ++g) {
        for (std::size_t k = 0; k < leaving[g].size(); ++k) {
            if (leaving[g].tag[k] == member) tables_[g].take(leaving[g], k);
        }
    }
}

void ContactPass::own(const ContactRules& rules, const NeighbourLists& lists, std::int32_t begin,
                      std::int32_t end) {
    begin_ = begin;
    end_ = end;
    incoming_.clear();
    const NeighbourList& list = lists.pairs;
    halo_.own(begin, end, list.farthest_partner, static_cast<std::int32_t>(list.start.size()) - 1);
    for (std::int32_t i = std::max(0, begin - list.farthest_partner); i < begin; ++i) {
        for (std::int32_t at = list.start[i]; at < list.start[i + 1]; ++at) {
            if (!owns(list.partner[at])) continue;
            incoming_.push_back({i, list.partner[at]});
            halo_.need(i);
        }
    }
    for (std::int32_t i = std::max(begin, end - list.farthest_partner); i < end; ++i)
        for (std::int32_t at = list.start[i]; at < list.start[i + 1]; ++at) halo_.need(list.partner[at]);
    if (tables_.size() == rules.groups.size()) return;
    tables_.resize(rules.groups.size());
    for (std::size_t g = 0; g < tables_.size(); ++g)
        tables_[g].shape(rules.groups[g].history_size(), rules.groups[g].number_size());
}

void ContactPass::list_foreign(const ContactRules& rules, Grains& grains, const Shares& shares) {
    const auto need = [&](const std::int32_t* bodies, std::int32_t begin, std::int32_t end) {
        for (std::int32_t c = begin; c < end; ++c) halo_.need(bodies[c]);
    };
    halo_.begin_list();
    for (std::size_t g = 0; g < tables_.size(); ++g) {
        const ContactTable& table = tables_[g];
        if (!rules.groups[g].of_pairs) continue;
        table.each_stretch([&](std::int32_t begin, std::int32_t end) {
            need(table.first(), begin, end);
            need(table.second(), begin, end);
        });
        need(table.near_first(), 0, table.candidates());
        need(table.near_second(), 0, table.candidates());
    }
    halo_.end_list(grains, shares);
}

void ContactPass::list_near_pairs(const ContactRules& rules, const Grains& grains, const NeighbourList& list,
                                  double skin) {
    const bool one_group = rules.one_group_of_pairs();
    const auto sort_in = [&](std::int32_t i, std::int32_t j) {
        const std::int32_t group =
            one_group ? 0 : rules.group_of_pair[grains.species[i] * rules.species + grains.species[j]];
        tables_[group].offer(i, j);
    };
    NearPairs pairs(grains, rules.period, skin, sort_in);
    for (const Pair& pair : incoming_) pairs.add(pair.first, pair.second);
    for (std::int32_t i = begin_; i < end_; ++i) {
        for (std::int32_t at = list.start[i], last = list.start[i + 1]; at < last; ++at)
            pairs.add(i, list.partner[at]);
    }
    pairs.flush();
}

void ContactPass::list_near_walls(const ContactRules& rules, const Grains& grains,
                                  const std::vector<WallNeighbour>& list, const std::vector<Face>& faces,
                                  const Pose& pose, double skin) {
    const std::int32_t last = first_wall_slot(list, end_);
    for (std::int32_t at = first_wall_slot(list, begin_); at < last; ++at) {
        const auto [grain, face] = list[at];
        const Place& place = grains.place[grain];
        const Vec3 moved = faces[face].displacement(pose);
        if (distance_to(faces[face], moved, place.position).distance < place.radius + skin)
            tables_[rules.group_of_wall[grains.species[grain]]].offer(grain, face);
    }
}

void ContactPass::list_candidates(const ContactRules& rules, const Grains& grains,
                                  const NeighbourLists& lists, const std::vector<Face>& faces,
                                  const Pose& pose, double skin) {
    for (ContactTable& table : tables_) table.begin_candidates();
    list_near_pairs(rules, grains, lists.pairs, skin);
    list_near_walls(rules, grains, lists.walls, faces, pose, skin);
    for (ContactTable& table : tables_) table.end_candidates();
}

void ContactPass::refresh(const ContactRules& rules, const Grains& grains, const NeighbourLists& lists,
                          const std::vector<Face>& faces, const Pose& pose, double skin) {
    for (ContactTable& table : tables_) table.sort();
    list_candidates(rules, grains, lists, faces, pose, skin);
}

std::int64_t ContactPass::parted() const {
    std::int64_t count = 0;
    for (const ContactTable& table : tables_) {
        table.each_stretch([&](std::int32_t begin, std::int32_t end) {
            for (std::int32_t c = begin; c < end; c += kChunk) {
                const std::uint64_t all = ~table.touching(c) & bits_of_first(end - c);
                if (begin_ == 0) count += std::popcount(all);
                for (std::uint64_t left = begin_ == 0 ? 0 : all; left != 0; left &= left - 1)
                    count += table.first()[c + std::countr_zero(left)] >= begin_;
            }
        });
    }
    return count;
}

void ContactPass::keep(std::vector<KeptContacts>& kept) const {
    kept.resize(tables_.size());
    for (std::size_t g = 0; g < tables_.size(); ++g) {
        const ContactTable& table = tables_[g];
        kept[g].clear();
        table.each_stretch([&](std::int32_t begin, std::int32_t end) {
            for (std::int32_t c = begin; c < end; ++c) {
                if (table.first()[c] >= begin_) table.keep(c, table.age(c), kept[g]);
            }
        });
    }
}

void ContactPass::restore(const ContactRules& rules, const std::vector<KeptContacts>& kept,
                          std::int32_t steps) {
    for (std::size_t g = 0; g < tables_.size(); ++g) {
        for (std::size_t k = 0; k < kept[g].size(); ++k) {
            if (owns(kept[g].first[k]) || (rules.groups[g].of_pairs && owns(kept[g].second[k])))
                tables_[g].restore(kept[g], k);
        }
        tables_[g].end_restore(steps);
    }
}

// Sets touch_ for the chunk, in floats if `rounded`; what its laws take.
LawInput ContactPass::prepare(const ContactRules& rules, const ContactGroup& group, const Grains& grains,
                              const WallState& state, const Times& times, const Chunk& chunk,
                              const Halo::Bodies& bodies, bool rounded) const {
    const GeometryInput in{&grains,
                           bodies.first,
                           bodies.second,
                           chunk.count,
                           group.rolling ? Wants::rolling : wants_of(*group.law),
                           rules.arms,
                           times.since,
                           group.law->at_mid_step ? times.turns : 0,
                           &rolling_,
                           group.law->uses_mass,
                           group.law->uses_radius || group.rolling,
                           rounded};
    group.of_pairs ? touch_pairs(in, rules.period, touch_) : touch_walls(in, state, touch_);
    touch_.touching &= bits_of_first(chunk.count);  // not the fill
    std::fill_n(kind_, kChunk, 0);
    if (group.needs_rows()) {
        for (int c = 0; c < chunk.count; ++c) {
            const std::int32_t one = grains.species[chunk.first[c]];
            kind_[c] =
                group.row[group.of_pairs ? one * rules.species + grains.species[chunk.second[c]] : one];
        }
    }
    return {chunk.count,          &touch_,  kind_, &group.parameters, times.since, times.ahead,
            group.history_size(), &rolling_};
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

std::uint64_t ContactPass::which_touch(const ContactRules& rules, const ContactGroup& group,
                                       const Grains& grains, const WallState& state, const Chunk& chunk) {
    const std::uint64_t touching =
        group.of_pairs ? near_pairs(grains, chunk.first, chunk.second, chunk.count, rules.period, 0)
                       : touching_walls(grains, chunk.first, chunk.second, chunk.count, state);
    return touching & bits_of_first(chunk.count);
}

// work(c, bits): of the 64 candidates from c on, those that touch.
template <class Work>
void ContactPass::each_touching_candidate(const ContactRules& rules, const ContactGroup& group,
                                          const ContactTable& table, const Grains& grains,
                                          const WallState& state, Halo* halo, const Work& work) {
    for (std::int32_t c = 0; c < table.candidates(); c += kChunk) {
        Chunk chunk{table.near_first() + c, table.near_second() + c,
                    std::min(kChunk, table.candidates() - c)};
        if (halo && group.of_pairs) {
            const auto [first, second] = halo->find(chunk.first, chunk.second, chunk.count);
            chunk.first = first, chunk.second = second;
        }
        if (group.of_pairs && is_large_bed(grains)) fetch_places(grains, table, c);
        work(c, which_touch(rules, group, grains, state, chunk));
    }
}

void ContactPass::compute(const ContactRules& rules, Grains& grains, const WallState& state,
                          const Times& times, Vanguard& vanguard, CostClock& clock) {
    for (std::size_t g = tables_.size(); g-- > 0;) {
        ContactTable& table = tables_[g];
        const Step in{rules, rules.groups[g], grains, state, times};
        table.begin_step();
        each_touching_candidate(rules, in.group, table, grains, state, &halo_,
                                [&](std::int32_t c, std::uint64_t touching) { table.admit(c, touching); });
        table.end_step();
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

void ContactPass::compute_chunk(const Step& in, ContactTable& table, std::int32_t c, int count,
                                CostClock& clock) {
    const ContactGroup& group = in.group;
    const Chunk chunk{table.first() + c, table.second() + c, count};
    const bool rounded = group.number_size() == sizeof(float);
    const bool large = group.of_pairs && c < table.sorted() && is_large_bed(in.grains);
    touch_.ahead = large ? &ahead_ : nullptr;
    if (large) look_ahead(in.grains, rounded, table, c, count, ahead_);
    const Halo::Bodies bodies = group.of_pairs ? halo_.find(chunk.first, chunk.second, count)
                                               : Halo::Bodies{chunk.first, chunk.second};
    const LawInput law = prepare(in.rules, group, in.grains, in.walls, in.times, chunk, bodies, rounded);
    table.note_touching(c, touch_.touching);
    void* history = table.histories().of_block(c);
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
                                 rounded};
    group.of_pairs ? add_pairs(forces, in.grains)
                   : add_walls(forces, loads_, in.walls, in.times.acts, in.grains);
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
            const LawInput in =
                prepare(rules, group, grains, state, {0, 0, 0, 0}, chunk, {chunk.first, chunk.second}, false);
            show(group, in, table.histories().of_block(c), chunk, begin > 0, seen);
        }
    });
    // Where positions have moved on since the forces, some touch that had none yet.
    Histories none;
    none.shape(group.history_size(), group.number_size());
    none.resize(kBlock);
    each_touching_candidate(
        rules, group, table, grains, state, nullptr, [&](std::int32_t c, std::uint64_t touching) {
            for (std::uint64_t left = touching & ~table.admitted(c); left != 0; left &= left - 1) {
                std::int32_t first[kBlock], second[kBlock];
                std::fill_n(first, kBlock, table.near_first()[c + std::countr_zero(left)]);
                std::fill_n(second, kBlock, table.near_second()[c + std::countr_zero(left)]);
                const Chunk chunk{first, second, 1};
                show(group,
                     prepare(rules, group, grains, state, {0, 0, 0, 0}, chunk, {chunk.first, chunk.second},
                             false),
                     none.of_block(0), chunk, true, seen);
            }
        });
}

}  // namespace grainreel
