#include "engine/step/lists/mesh_near.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/mesh/surface.hpp"

namespace grainreel {

void MeshLists::clear() {
    near.clear(), triangles.clear(), touch.clear();
    std::swap(known_, before_);
    known_.clear();
    next_ = 0;
}

// Returns the triangles that were found around this grain before, if they reach far enough. Otherwise it
// finds them anew, with some room for later. Most grains stay near a place of the mesh for many refreshes.
const MeshLists::Around& MeshLists::around(std::int32_t grain, std::int32_t mesh, const Surface& surface,
                                           const Vec3& centre, double reach) {
    constexpr double kRoom = 0.1;  // as a share of the reach
    const auto is_before = [&](const Around& one) {
        return one.grain != grain ? one.grain < grain : one.mesh < mesh;
    };
    while (next_ < before_.places.size() && is_before(before_.places[next_])) ++next_;
    Around here{grain, mesh, centre, reach * (1 + kRoom), known_.triangles.size(), 0};
    const Around* const was = next_ < before_.places.size() ? &before_.places[next_] : nullptr;
    if (was && was->grain == grain && was->mesh == mesh &&
        (1 + 1e-9) * ((centre - was->centre).norm() + reach) < was->reach) {
        here.centre = was->centre;
        here.reach = was->reach;
        const auto from = before_.triangles.begin() + static_cast<std::ptrdiff_t>(was->first);
        known_.triangles.insert(known_.triangles.end(), from, from + static_cast<std::ptrdiff_t>(was->count));
    } else {
        surface.near(centre, here.reach, known_.triangles);
    }
    here.count = known_.triangles.size() - here.first;
    return known_.places.emplace_back(here);
}

void MeshLists::add(std::int32_t grain, std::int32_t mesh, const Surface& surface, const Vec3& centre,
                    double reach) {
    constexpr double kLess = 1 - 1e-9;
    const Around& all = around(grain, mesh, surface, centre, reach);
    const std::size_t first = triangles.size();
    for (std::size_t k = all.first; k < all.first + all.count; ++k) {
        const std::int32_t triangle = known_.triangles[k];
        const double squared = surface.nearest(triangle, centre).squared;
        if (squared <= reach * reach) triangles.push_back({triangle, kLess * std::sqrt(squared)});
    }
    if (triangles.size() == first) return;
    std::sort(triangles.begin() + static_cast<std::ptrdiff_t>(first), triangles.end(),
              [](const NearTriangle& a, const NearTriangle& b) { return a.distance < b.distance; });
    MeshNear one{grain,
                 mesh,
                 centre,
                 static_cast<std::int32_t>(first),
                 static_cast<std::int32_t>(triangles.size() - first),
                 0,
                 -1,
                 0,
                 {},
                 MeshNear::kNone};
    one.contact.fill(MeshNear::kNone);
    find_flat(surface, reach, one);
    near.push_back(one);
}

// `stays` is reduced by kOff times the reach. The nearest point then stays so far from the edges that nothing
// beyond them is as near, despite rounding and the tilt of neighbours that count as flat.
void MeshLists::find_flat(const Surface& surface, double reach, MeshNear& one) const {
    constexpr double kOff = 1e-5;
    const NearTriangle* const own = triangles.data() + one.first;
    one.stays = surface.stays_on_face(own->number, one.centre) - kOff * reach;
    one.flat = 1;
    const auto is_beside = [&](std::int32_t other) {
        for (int edge = 0; edge < 3; ++edge) {
            const Neighbour& beyond = surface.neighbour(own->number, edge);
            if (beyond.triangle == other) return beyond.turn == Neighbour::Turn::flat;
        }
        return false;
    };
    while (one.flat < one.count && is_beside(own[one.flat].number)) ++one.flat;
}

void MeshLists::find_contacts(const ContactTable& table) {
    const auto place = [](std::int32_t grain, std::int32_t mesh) { return std::pair(grain, mesh); };
    table.each_stretch([&](std::int32_t from, std::int32_t to) {
        for (std::int32_t c = from; c < to; ++c) {
            const auto wanted = place(table.first()[c], mesh_of(table.second()[c]));
            const auto found = std::lower_bound(
                near.begin(), near.end(), wanted,
                [&](const MeshNear& one, const auto& other) { return place(one.grain, one.mesh) < other; });
            if (found != near.end() && place(found->grain, found->mesh) == wanted)
                found->set_contact(table.second()[c] % kMostPatches, c);
        }
    });
}

}  // namespace grainreel
