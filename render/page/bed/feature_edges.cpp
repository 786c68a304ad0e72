#include "render/page/bed/feature_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainreel {

std::vector<std::array<std::int32_t, 2>> feature_edges(const Surface& surface) {
    const double same = std::cos(30 * std::numbers::pi / 180);
    std::vector<std::array<std::int32_t, 2>> edges;
    for (std::int32_t t = 0; t < surface.size(); ++t)
        for (int e = 0; e < 3; ++e) {
            const Neighbour& next = surface.neighbour(t, e);
            if (next.triangle >= 0) {
                if (next.triangle < t) continue;  // the other one has it
                const double cosine = surface.normal(t).dot(surface.normal(next.triangle));
                if ((next.flips ? -cosine : cosine) >= same) continue;
            }
            const auto& corners = surface.mesh().triangles[static_cast<std::size_t>(t)];
            const std::int32_t a = corners[static_cast<std::size_t>(e)],
                               b = corners[static_cast<std::size_t>((e + 1) % 3)];
            edges.push_back({std::min(a, b), std::max(a, b)});
        }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

}  // namespace grainreel
