#include "render/picture/spheres/light/neighbourhood.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace grainreel {
namespace {

constexpr std::size_t kMostCasters = 24;
// Neighbours stand for what is farther away, too.
constexpr float kFarther = 1.3f;

NearGrain neighbour(const ViewSphere& own, const ViewSphere& other, float weight) {
    return {other.x - own.x, other.y - own.y,  other.z - own.z,
            other.radius,    1 / other.radius, other.radius * other.radius,
            weight};
}

}  // namespace

// 1 for those that touch, falling to 0 at the end of their reach, so that nobody comes or goes at once.
float Neighbourhood::weight(const ViewSphere& own, const ViewSphere& other) const {
    const float dx = other.x - own.x, dy = other.y - own.y, dz = other.z - own.z;
    const float gap = std::sqrt(dx * dx + dy * dy + dz * dz) - own.radius - other.radius;
    const float left = 1 - gap / (kReach * other.radius);
    return kFarther * std::clamp(2 * left, 0.0f, 1.0f) * cut_.share(other);
}

void Neighbourhood::find_occluders(std::size_t slot, std::uint32_t pool) {
    Pool& into = pools_[pool];
    const std::uint32_t i = (*shown_)[slot];
    const ViewSphere& own = (*spheres_)[i];
    into.found.clear();
    into.forget_met();
    const std::size_t first = into.all.size();
    grid_.around(own, [&](std::uint32_t j) {
        if (into.has_met(j)) return;
        const ViewSphere& other = (*spheres_)[j];
        const float dx = other.x - own.x, dy = other.y - own.y, dz = other.z - own.z;
        const float reach = own.radius + (1 + kReach) * other.radius;
        if (j != i && dx * dx + dy * dy + dz * dz < reach * reach) into.found.push_back(j);
    });
    for (const std::uint32_t j : into.found) {
        const ViewSphere& other = (*spheres_)[j];
        const float taken = weight(own, other);
        if (taken > 0) into.all.push_back(neighbour(own, other, taken));
    }
    occluders_[slot] = {pool, static_cast<std::uint32_t>(into.all.size() - first), first};
}

void Neighbourhood::find_casters(std::size_t slot, std::uint32_t pool) {
    Pool& into = pools_[pool];
    const std::uint32_t i = (*shown_)[slot];
    const ViewSphere& own = (*spheres_)[i];
    const float height = grid_.height(own);
    into.found.clear();
    into.forget_met();
    const std::size_t first = into.all.size();
    const auto visit = [&](std::uint32_t j) {
        if (into.has_met(j)) return;
        const ViewSphere& other = (*spheres_)[j];
        const float ahead = grid_.height(other) - height;
        if (j == i || ahead <= 0 || cut_.share(other) <= 0) return;
        const float dx = other.x - own.x, dy = other.y - own.y, dz = other.z - own.z;
        const float beside = dx * dx + dy * dy + dz * dz - ahead * ahead;
        const float touch = own.radius + other.radius + lamp_.spread * ahead;
        if (beside <= touch * touch) into.found.push_back(j);
    };
    grid_.towards_light(own, 0.3f * own.radius, visit, [&] { return into.found.size() >= kMostCasters; });
    for (const std::uint32_t j : into.found)
        into.all.push_back(neighbour(own, (*spheres_)[j], cut_.share((*spheres_)[j])));
    casters_[slot] = {pool, static_cast<std::uint32_t>(into.all.size() - first), first};
}

void Neighbourhood::update(const std::vector<ViewSphere>& spheres, const Cut& cut, const Lamp& lamp,
                           const std::vector<std::uint32_t>& shown, Team& team) {
    spheres_ = &spheres;
    shown_ = &shown;
    cut_ = cut;
    lamp_ = lamp;
    occluders_.assign(shown.size(), {});
    casters_.assign(shown.size(), {});
    pools_.resize(static_cast<std::size_t>(team.size()));
    if (shown.empty() || (!lamp.occlusion && !lamp.shadows)) return;
    grid_.fill(spheres, lamp, kReach);
    constexpr std::size_t kShare = 64;
    std::atomic<std::size_t> next{0};
    team.run([&](int member) {
        const auto pool = static_cast<std::uint32_t>(member);
        pools_[pool].all.clear();
        pools_[pool].met_by.resize(spheres.size(), 0);
        for (std::size_t begin; (begin = next.fetch_add(kShare, std::memory_order_relaxed)) < shown.size();)
            for (std::size_t slot = begin; slot < std::min(begin + kShare, shown.size()); ++slot) {
                if (lamp.occlusion) find_occluders(slot, pool);
                if (lamp.shadows) find_casters(slot, pool);
            }
    });
}

}  // namespace grainreel
