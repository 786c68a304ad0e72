#include "engine/step/lists/mesh_near.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grainreel {

void MeshLists::add(std::int32_t grain, std::int32_t mesh, const Surface& surface, const Vec3& centre,
                    double reach) {
    constexpr double kLess = 1 - 1e-9;
    found_.clear();
    surface.near(centre, reach, found_);
    if (found_.empty()) return;
    const std::size_t first = triangles.size();
    for (const std::int32_t triangle : found_)
        triangles.push_back({triangle, kLess * std::sqrt(surface.nearest(triangle, centre).squared)});
    std::sort(triangles.begin() + static_cast<std::ptrdiff_t>(first), triangles.end(),
              [](const NearTriangle& a, const NearTriangle& b) { return a.distance < b.distance; });
    MeshNear one{
        grain, mesh, centre, static_cast<std::int32_t>(first), static_cast<std::int32_t>(found_.size()), {}};
    one.contact.fill(MeshNear::kNone);
    near.push_back(one);
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
                found->contact[static_cast<std::size_t>(table.second()[c] % kMostPatches)] = c;
        }
    });
}

}  // namespace grainreel
