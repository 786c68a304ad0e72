// The lists of the contact pass: near pairs, the contacts of each thread, and contacts that have parted.
#include <algorithm>
#include <bit>
#include <utility>

#include "engine/step/forces/contact_pass.hpp"
#include "engine/step/grid/large_bed.hpp"

namespace grainreel {

namespace {

// Collects pairs into chunks, and passes on those that are closer than `gap` (m).
template <class Pass>
class NearPairs {
  public:
    NearPairs(const Grains& grains, double period, double gap, const Pass& pass)
        : grains_(grains), period_(period), gap_(gap), pass_(pass) {}
    void add(std::int32_t i, std::int32_t j) {
        first_[count_] = i, second_[count_] = j;
        if (++count_ == kChunk) pass_chunk();
    }
    // Adds all partners of a grain. They are copied eight at a time, so that the processor need not predict
    // how many there are. Memory behind the partners can be read up to `end`.
    void add(std::int32_t i, const std::int32_t* partner, std::int32_t partners, const std::int32_t* end) {
        if (end - partner < partners + kMore) {
            for (std::int32_t k = 0; k < partners; ++k) add(i, partner[k]);
            return;
        }
        for (std::int32_t k = 0; k < partners; k += kMore) {
            std::fill_n(first_ + count_, kMore, i);
            std::copy_n(partner + k, kMore, second_ + count_);
            count_ += std::min(kMore, partners - k);
            if (count_ >= kChunk) pass_chunk();
        }
    }
    void flush() {
        // Copies of the last pair fill the last block. This thread may read them.
        for (int k = count_; k > 0 && k % kBlock != 0; ++k)
            first_[k] = first_[k - 1], second_[k] = second_[k - 1];
        pass_near(count_);
        count_ = 0;
    }

  private:
    static constexpr int kMore = 8;

    void pass_chunk() {
        pass_near(kChunk);
        std::copy_n(first_ + kChunk, kMore, first_);
        std::copy_n(second_ + kChunk, kMore, second_);
        count_ -= kChunk;
    }
    void pass_near(int count) {
        std::uint64_t left = near_pairs(grains_, first_, second_, count, period_, gap_);
        left &= bits_of_first(count);
        for (; left != 0; left &= left - 1) {
            const int k = std::countr_zero(left);
            pass_(first_[k], second_[k]);
        }
    }

    const Grains& grains_;
    const double period_, gap_;
    const Pass& pass_;
    std::int32_t first_[kChunk + kMore] = {}, second_[kChunk + kMore] = {};
    int count_ = 0;
};

// Where the wall neighbours of the grains from `begin` on start in the list.
std::int32_t first_wall_slot(const std::vector<WallNeighbour>& list, std::int32_t begin) {
    const auto lower = [](const WallNeighbour& w, std::int32_t grain) { return w.grain < grain; };
    return static_cast<std::int32_t>(std::lower_bound(list.begin(), list.end(), begin, lower) - list.begin());
}

// Changes the history of a contact whose bodies change places.
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

void ContactPass::count_contacts(const std::vector<std::int32_t>& index,
                                 std::vector<std::int32_t>& count) const {
    for (const ContactTable& table : tables_) {
        table.each_stretch([&](std::int32_t begin, std::int32_t end) {
            for (std::int32_t c = begin; c < end; ++c) {
                const std::int32_t first = table.first()[c];
                if (table.touches(c) && owns(first)) ++count[index[first]];
            }
        });
    }
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

void ContactPass::leave_out(const ContactRules& rules, const std::vector<std::int32_t>& index) {
    for (std::size_t g = 0; g < tables_.size(); ++g) {
        const bool pairs = rules.groups[g].of_pairs;
        ContactTable& table = tables_[g];
        for (std::int32_t c = 0; c < table.size(); ++c) {
            if (!table.touches(c)) continue;
            const std::int32_t i = index[table.first()[c]];
            const std::int32_t j = pairs ? index[table.second()[c]] : table.second()[c];
            i == kGone || j == kGone ? table.drop(c) : table.renumber(c, i, j);
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
    found_.resize(rules.groups.size());
    soon_.resize(rules.groups.size());
    for (std::size_t g = 0; g < tables_.size(); ++g)
        tables_[g].shape(rules.groups[g].history_size(), rules.groups[g].number_size());
}

void ContactPass::list_foreign(const ContactRules& rules, Grains& grains, const Shares& shares) {
    halo_.begin_list();
    for (std::size_t g = 0; g < tables_.size(); ++g) {
        const ContactTable& table = tables_[g];
        if (!rules.groups[g].of_pairs) continue;
        table.each_stretch([&](std::int32_t begin, std::int32_t end) {
            halo_.need(table.first() + begin, table.second() + begin, end - begin);
        });
        halo_.need(table.near_first(), table.near_second(), table.candidates());
    }
    halo_.end_list(grains, shares);
    for (std::size_t g = 0; g < tables_.size(); ++g) {
        const ContactTable& table = tables_[g];
        if (!rules.groups[g].of_pairs) continue;
        found_[g].contacts.set(halo_, table.first(), table.second(), table.sorted());
        found_[g].candidates.set(halo_, table.near_first(), table.near_second(), table.candidates());
    }
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
    const std::int32_t *const start = list.start.data(), *const partner = list.partner.data();
    for (std::int32_t i = begin_; i < end_; ++i)
        pairs.add(i, partner + start[i], start[i + 1] - start[i], partner + list.partner.size());
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
    for (std::size_t g = 0; g < tables_.size(); ++g)
        if (rules.groups[g].of_pairs && !is_large_bed(grains)) soon_[g].expire(tables_[g].candidates());
    skin_ = skin;
}

void ContactPass::note_loaded(bool of_pairs, const ContactTable& table, std::int32_t begin,
                              std::int32_t end) {
    for (std::int32_t c = begin; c < end; ++c) {
        loaded_.note(table.first()[c]);
        if (of_pairs) loaded_.note(table.second()[c]);
    }
}

void ContactPass::note_loaded(const ContactRules& rules) {
    loaded_.clear(begin_, end_);
    for (std::size_t g = 0; g < tables_.size(); ++g) {
        tables_[g].each_stretch([&](std::int32_t begin, std::int32_t end) {
            note_loaded(rules.groups[g].of_pairs, tables_[g], begin, end);
        });
    }
}

void ContactPass::note_loads(const Grains& grains) {
    for (std::int32_t i = begin_; i < end_; ++i)
        if (grains.load[i].force != Vec3::Zero() || grains.load[i].torque != Vec3::Zero()) loaded_.note(i);
}

void ContactPass::refresh(const ContactRules& rules, const Grains& grains, const NeighbourLists& lists,
                          const std::vector<Face>& faces, const Pose& pose, double skin) {
    for (ContactTable& table : tables_) table.sort();
    note_loaded(rules);
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
    note_loaded(rules);
}

}  // namespace grainreel
