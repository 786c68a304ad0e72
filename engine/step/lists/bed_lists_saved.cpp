// How lists and histories are saved, and how they come back.
#include <algorithm>
#include <numeric>

#include "engine/base/binary.hpp"
#include "engine/step/lists/bed_lists.hpp"
#include "engine/step/lists/candidates.hpp"
#include "engine/step/lists/saved_lists.hpp"

namespace grainreel {

namespace {

// The order in which contacts are computed.
KeptContacts in_order(const KeptContacts& kept, int numbers) {
    std::vector<std::int32_t> order(kept.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](auto a, auto b) { return order_of(kept, a) < order_of(kept, b); });
    KeptContacts sorted;
    for (const std::int32_t c : order) {
        sorted.first.push_back(kept.first[c]);
        sorted.second.push_back(kept.second[c]);
        sorted.tag.push_back(kept.tag[c]);
        const auto history = kept.history.begin() + static_cast<std::ptrdiff_t>(c) * numbers;
        sorted.history.insert(sorted.history.end(), history, history + numbers);
    }
    return sorted;
}

}  // namespace

// All contacts in one order, whoever works on them.
std::vector<KeptContacts> BedLists::all_kept() const {
    std::vector<KeptContacts> all(rules_.groups.size()), part;
    for (const Thread& thread : threads_) {
        thread.contacts.keep(part);
        for (std::size_t g = 0; g < part.size(); ++g) all[g].append(part[g]);
    }
    for (std::size_t g = 0; g < all.size(); ++g) all[g] = in_order(all[g], rules_.groups[g].history_size());
    return all;
}

// Everything saved, in its order.
template <class Lists, class Kept, class ReachType, class Each>
void BedLists::transfer(Lists& lists, Kept& kept, std::int32_t& steps, ReachType& reach, const Each& each) {
    for (auto& group : kept) each(group.first), each(group.second), each(group.tag), each(group.history);
    each(steps);
    each(lists.lists_.pairs.start), each(lists.lists_.pairs.partner);
    each(lists.lists_.pairs.farthest_partner);
    each(lists.lists_.walls);
    if (!lists.around_.glued.empty()) each(lists.lists_.glued);
    if (!lists.around_.meshes.empty()) each(lists.lists_.meshes);
    ListLife::transfer(lists.life_, each);
    each(reach);
}

void BedLists::save(std::ostream& out) const {
    const std::vector<KeptContacts> kept = all_kept();
    std::int32_t steps = contacts(0).steps_since_refresh();
    transfer(*this, kept, steps, life_.reach(0), Writing{out});
}

void BedLists::load(Bytes& in, const Pose& now) {
    std::vector<KeptContacts> kept(rules_.groups.size());
    Reach reach;
    std::int32_t steps = 0;
    transfer(*this, kept, steps, reach, Reading{in});
    if (in.failed() || !is_sound(kept, steps, reach)) return in.fail();  // the caller says so
    if (team_.size() > 1) contacts_.assign(grains_.size(), 0);
    shares_.share_out(lists_.pairs, contacts_, grains());
    for (int thread = 0; thread < team_.size(); ++thread) {
        life_.reach(thread) = reach;
        ThreadContacts& mine = contacts(thread);
        mine = {};
        mine.own(rules_, lists_, begin(thread), end(thread));
        mine.restore(rules_, kept, steps);
    }
    grains_.rounded.resize(rules_.rounds ? grains_.size() : 0);
    place_halos();
    for (Thread& thread : threads_) {
        list_candidates(rules_, nearby(now, reach.skin), thread.contacts);
        if (team_.size() > 1) thread.contacts.list_foreign(rules_, grains_, shares_.now());
    }
}

// A contact of two threads' grains stands in the tables of both. All patches that a grain touches of a mesh
// take one history.
void BedLists::take_histories(const HistoryOf& history_of) {
    for (Thread& thread : threads_) {
        for (std::size_t g = 0; g < thread.contacts.tables.size(); ++g) {
            const ContactGroup& group = rules_.groups[g];
            thread.contacts.tables[g].take_histories(
                group.law_size(), [&](std::int32_t first, std::int32_t second, double* to) {
                    return history_of(g, first, group.of_mesh ? mesh_of(second) : second, to);
                });
        }
    }
}

// Whether the loop could have made what load() read, with these grains and faces.
bool BedLists::is_sound(const std::vector<KeptContacts>& kept, std::int32_t steps, const Reach& reach) const {
    const WallParts walls = parts_of(around_);
    bool sound = steps >= 0 && steps <= kMostStepsOfLists && are_sound(lists_, grains(), walls) &&
                 life_.is_sound(grains(), reach);
    for (std::size_t g = 0; sound && g < kept.size(); ++g)
        sound = are_sound(kept[g], rules_, g, grains_, walls, steps);
    return sound;
}

}  // namespace grainreel
