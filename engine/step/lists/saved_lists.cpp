#include "engine/step/lists/saved_lists.hpp"

#include <algorithm>
#include <cmath>

#include "engine/mesh/surface.hpp"

namespace grainreel {

namespace {

bool within(std::int32_t index, std::int32_t count) {
    return index >= 0 && index < count;
}

bool is_sound(const NeighbourList& list, std::int32_t grains) {
    const auto& start = list.start;
    const auto& partner = list.partner;
    if (std::ssize(start) != grains + std::ptrdiff_t{1} || start.front() != 0 ||
        start.back() != std::ssize(partner) || !std::is_sorted(start.begin(), start.end()))
        return false;
    std::int32_t farthest = 0;
    for (std::int32_t i = 0; i < grains; ++i) {
        for (std::int32_t at = start[i], before = i; at < start[i + 1]; before = partner[at++]) {
            if (partner[at] <= before || partner[at] >= grains) return false;
            farthest = std::max(farthest, partner[at] - i);
        }
    }
    return list.farthest_partner == farthest;
}

bool is_sound(const std::vector<WallNeighbour>& list, std::int32_t grains, std::int32_t parts) {
    const auto inside = [&](const WallNeighbour& w) {
        return within(w.grain, grains) && within(w.face, parts);
    };
    const auto before = [](const WallNeighbour& a, const WallNeighbour& b) {
        return a.grain != b.grain ? a.grain < b.grain : a.face < b.face;
    };
    return std::all_of(list.begin(), list.end(), inside) && std::is_sorted(list.begin(), list.end(), before);
}

}  // namespace

WallParts parts_of(const Surroundings& around) {
    WallParts parts{static_cast<std::int32_t>(around.faces.size()),
                    static_cast<std::int32_t>(around.glued.size())};
    for (const MeshWall& mesh : around.meshes) parts.triangles.push_back(mesh.surface->size());
    return parts;
}

bool are_sound(const NeighbourLists& lists, std::int32_t grains, const WallParts& walls) {
    return is_sound(lists.pairs, grains) && is_sound(lists.walls, grains, walls.faces) &&
           is_sound(lists.glued, grains, walls.glued) && is_sound(lists.meshes, grains, walls.meshes());
}

ContactOrder order_of(const KeptContacts& kept, std::size_t c) {
    return {ContactTable::began(kept.tag[c]), kept.first[c], kept.second[c]};
}

namespace {

// The number of second bodies that a group can have.
std::int32_t others_of(const ContactGroup& group, std::int32_t grains, const WallParts& walls) {
    if (group.of_pairs) return grains;
    if (group.of_mesh) return kMostPatches * walls.meshes();
    return group.of_glued ? walls.glued : walls.faces;
}

// The group that the contact of grain i with second body j belongs to.
std::int32_t group_of(const ContactRules& rules, const ContactGroup& group, const Grains& grains,
                      std::int32_t i, std::int32_t j) {
    const std::int32_t s = grains.species[i];
    if (group.of_pairs) return rules.group_of_pair[s * rules.species + grains.species[j]];
    if (group.of_mesh) return static_cast<std::int32_t>(rules.group_of(mesh_of(j), s));
    return (group.of_glued ? rules.group_of_glued : rules.group_of_wall)[s];
}

// Whether a patch of a mesh with `triangles` triangles may remember these numbers.
bool is_patch(const double* numbers, std::int32_t triangles) {
    const double triangle = numbers[kTriangle];
    const Vec3 normal(numbers[kNormalX], numbers[kNormalY], numbers[kNormalZ]);
    return triangle >= 0 && triangle < triangles && triangle == std::floor(triangle) &&
           normal.squaredNorm() < 2;
}

}  // namespace

bool are_sound(const KeptContacts& kept, const ContactRules& rules, std::size_t g, const Grains& grains,
               const WallParts& walls, std::int32_t steps) {
    const ContactGroup& group = rules.groups[g];
    const auto count = static_cast<std::int32_t>(grains.size());
    const std::int32_t others = others_of(group, count, walls);
    const std::size_t size = kept.size();
    if (kept.second.size() != size || kept.tag.size() != size ||
        kept.history.size() != size * static_cast<std::size_t>(group.history_size()))
        return false;
    if (!std::all_of(kept.history.begin(), kept.history.end(), [](double h) { return std::isfinite(h); }))
        return false;
    for (std::size_t c = 0; c < size; ++c) {
        const std::int32_t i = kept.first[c], j = kept.second[c];
        if (!within(i, count) || !within(j, others) || (group.of_pairs && j <= i)) return false;
        if (group_of(rules, group, grains, i, j) != static_cast<std::int32_t>(g)) return false;
        if (order_of(kept, c).began > steps) return false;
        const double* const behind = kept.history.data() + c * group.history_size() + group.law_size();
        if (group.of_mesh && !is_patch(behind, walls.triangles[mesh_of(j)])) return false;
        if (c > 0 && !(order_of(kept, c - 1) < order_of(kept, c))) return false;
    }
    return true;
}

std::vector<KeptContacts> read_contacts(Bytes& in, const ContactRules& rules, const Grains& grains,
                                        const WallParts& walls) {
    const Reading each{in};
    std::vector<KeptContacts> kept(rules.groups.size());
    for (KeptContacts& group : kept)
        each(group.first), each(group.second), each(group.tag), each(group.history);
    for (std::size_t g = 0; g < kept.size() && !in.failed(); ++g)
        if (!are_sound(kept[g], rules, g, grains, walls, kMostStepsOfLists)) in.fail();
    return kept;
}

}  // namespace grainreel
