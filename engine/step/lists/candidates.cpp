#include "engine/step/lists/candidates.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "engine/base/numbers.hpp"
#include "engine/laws/law_kernel.hpp"
#include "engine/step/geometry/contact_geometry.hpp"
#include "engine/step/lists/large_bed.hpp"

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
    // how many there are. Memory after the partners can be read up to `end`.
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

void list_near_pairs(const ContactRules& rules, const Nearby& nearby, ThreadContacts& contacts) {
    const Grains& grains = nearby.grains;
    const NeighbourList& list = nearby.lists.pairs;
    const bool one_group = rules.one_group_of_pairs();
    const auto sort_in = [&](std::int32_t i, std::int32_t j) {
        const std::int32_t group =
            one_group ? 0 : rules.group_of_pair[grains.species[i] * rules.species + grains.species[j]];
        contacts.tables[group].offer(i, j);
    };
    NearPairs pairs(grains, rules.period, nearby.skin, sort_in);
    for (const ThreadContacts::Pair& pair : contacts.incoming) pairs.add(pair.first, pair.second);
    const std::int32_t *const start = list.start.data(), *const partner = list.partner.data();
    for (std::int32_t i = contacts.begin; i < contacts.end; ++i)
        pairs.add(i, partner + start[i], start[i + 1] - start[i], partner + list.partner.size());
    pairs.flush();
}

// The place in the list where the wall neighbours of grain `begin` and of later grains begin.
std::int32_t first_wall_slot(const std::vector<WallNeighbour>& list, std::int32_t begin) {
    const auto lower = [](const WallNeighbour& w, std::int32_t grain) { return w.grain < grain; };
    return static_cast<std::int32_t>(std::lower_bound(list.begin(), list.end(), begin, lower) - list.begin());
}

void list_near_walls(const ContactRules& rules, const Nearby& nearby, ThreadContacts& contacts) {
    const std::vector<WallNeighbour>& list = nearby.lists.walls;
    const std::int32_t last = first_wall_slot(list, contacts.end);
    for (std::int32_t at = first_wall_slot(list, contacts.begin); at < last; ++at) {
        const auto [grain, face] = list[at];
        const Place& place = nearby.grains.place[grain];
        if (distance_at(nearby.faces[face], nearby.pose, place.position).distance <
            place.radius + nearby.skin)
            contacts.tables[rules.group_of_wall[nearby.grains.species[grain]]].offer(grain, face);
    }
}

void list_near_glued(const ContactRules& rules, const Nearby& nearby, ThreadContacts& contacts) {
    const std::vector<WallNeighbour>& list = nearby.lists.glued;
    const std::int32_t last = first_wall_slot(list, contacts.end);
    for (std::int32_t at = first_wall_slot(list, contacts.begin); at < last; ++at) {
        const auto [grain, glued] = list[at];
        const Place& place = nearby.grains.place[grain];
        Vec3 apart = nearby.glued.centre(glued, nearby.faces, nearby.pose) - place.position;
        apart.x() = wrapped(apart.x(), rules.period);
        if (apart.norm() < place.radius + nearby.glued.place[glued].radius + nearby.skin)
            contacts.tables[rules.group_of_glued[nearby.grains.species[grain]]].offer(grain, glued);
    }
}

// Lists the triangles that grains may touch; meshes have no other candidates.
void list_near_meshes(const ContactRules& rules, const Nearby& nearby, ThreadContacts& contacts) {
    if (nearby.meshes.empty()) return;
    for (MeshLists& lists : contacts.meshes) lists.clear();
    std::vector<BodyPose> poses;
    for (const MeshWall& mesh : nearby.meshes) poses.push_back(mesh.body.at(nearby.pose));
    const std::vector<WallNeighbour>& list = nearby.lists.meshes;
    const std::int32_t last = first_wall_slot(list, contacts.end);
    for (std::int32_t at = first_wall_slot(list, contacts.begin); at < last; ++at) {
        const auto [grain, mesh] = list[at];
        const Place& place = nearby.grains.place[grain];
        contacts.meshes[rules.group_of(mesh, nearby.grains.species[grain])].add(
            grain, mesh, *nearby.meshes[mesh].surface, poses[mesh].at_rest(place.position),
            place.radius + nearby.skin);
    }
    for (std::size_t g = 0; g < contacts.meshes.size(); ++g)
        if (rules.groups[g].of_mesh) contacts.meshes[g].find_contacts(contacts.tables[g]);
}

}  // namespace

void list_candidates(const ContactRules& rules, const Nearby& nearby, ThreadContacts& contacts) {
    for (ContactTable& table : contacts.tables) table.begin_candidates();
    list_near_pairs(rules, nearby, contacts);
    list_near_walls(rules, nearby, contacts);
    list_near_glued(rules, nearby, contacts);
    list_near_meshes(rules, nearby, contacts);
    for (ContactTable& table : contacts.tables) table.end_candidates();
    for (std::size_t g = 0; g < contacts.tables.size(); ++g)
        if (rules.groups[g].of_pairs && !is_large_bed(nearby.grains))
            contacts.soon[g].expire(contacts.tables[g].candidates());
    contacts.skin = nearby.skin;
    list_screens(rules, nearby, contacts);
}

void refresh(const ContactRules& rules, const Nearby& nearby, ThreadContacts& contacts) {
    for (ContactTable& table : contacts.tables) table.sort();
    contacts.note_loaded(rules);
    list_candidates(rules, nearby, contacts);
}

}  // namespace grainreel
