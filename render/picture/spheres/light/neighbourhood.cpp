// Finds the neighbours that take light from each grain, by a grid towards the light. Hot code.
#include "render/picture/spheres/light/neighbourhood.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>

namespace grainreel {

void LightGrid::set_axes(const Lamp& lamp) {
    const Eigen::Vector3f w(lamp.to_key[0], lamp.to_key[1], lamp.to_key[2]);
    const Eigen::Vector3f u = w.unitOrthogonal(), v = w.cross(u);
    const Eigen::Vector3f axes[3] = {u, v, w};
    for (int a = 0; a < 3; ++a)
        for (int c = 0; c < 3; ++c) axis_[a][c] = axes[a][c];
}

// Makes cells as wide as nearly all spheres. The few larger spheres are put into all cells that they reach.
void LightGrid::set_cells(const std::vector<ViewSphere>& spheres, float reach) {
    constexpr double kNearlyAll = 0.9, kMostCells = 4;  // cells a sphere
    std::vector<float> radii;
    const std::size_t stride = spheres.size() / 4096 + 1;
    for (std::size_t i = 0; i < spheres.size(); i += stride) radii.push_back(spheres[i].radius);
    const auto typical =
        radii.begin() + static_cast<std::ptrdiff_t>(kNearlyAll * static_cast<double>(radii.size() - 1));
    std::nth_element(radii.begin(), typical, radii.end());
    small_ = 1.2f * *typical;
    Place high = place(spheres[0]);
    low_ = high;
    for (const ViewSphere& s : spheres) {
        const Place at = place(s);
        for (int a = 0; a < 3; ++a) low_[a] = std::min(low_[a], at[a]), high[a] = std::max(high[a], at[a]);
    }
    double volume = 1;
    for (int a = 0; a < 3; ++a) volume *= static_cast<double>(high[a] - low_[a]) + 2 * small_;
    const double least = std::cbrt(volume / (kMostCells * static_cast<double>(spheres.size()) + 64));
    const float size = std::max(2 * small_, static_cast<float>(least));
    per_cell_ = 1 / size;
    for (int a = 0; a < 3; ++a) cells_[a] = static_cast<int>((high[a] - low_[a]) * per_cell_) + 1;
    reach_ = reach;
    widest_small_ = widest_any_ = 0;
    for (const ViewSphere& s : spheres) {
        widest_any_ = std::max(widest_any_, s.radius);
        if (s.radius <= small_) widest_small_ = std::max(widest_small_, s.radius);
    }
}

template <class Visit>
void LightGrid::for_cells(const ViewSphere& s, const Visit& visit) const {
    const Place at = place(s);
    const float wide = s.radius <= small_ ? 0 : (1 + reach_) * s.radius;
    for (int u = cell(at[0] - wide, 0); u <= cell(at[0] + wide, 0); ++u)
        for (int v = cell(at[1] - wide, 1); v <= cell(at[1] + wide, 1); ++v)
            for (int w = cell(at[2] - wide, 2); w <= cell(at[2] + wide, 2); ++w)
                visit(column(u, v) * cells_[2] + w);
}

void LightGrid::fill(const std::vector<ViewSphere>& spheres, const Lamp& lamp, float reach) {
    start_.clear();
    if (spheres.empty()) return;
    set_axes(lamp);
    set_cells(spheres, reach);
    const std::size_t columns = static_cast<std::size_t>(cells_[0]) * cells_[1];
    // Counts are stored two places on, so that start_ holds the starts of the cells once item_ is filled.
    start_.assign(columns * cells_[2] + 2, 0);
    for (const ViewSphere& s : spheres) for_cells(s, [&](std::size_t c) { ++start_[c + 2]; });
    for (std::size_t c = 2; c < start_.size(); ++c) start_[c] += start_[c - 1];
    item_.resize(start_.back());
    for (std::size_t i = 0; i < spheres.size(); ++i)
        for_cells(spheres[i], [&](std::size_t c) { item_[start_[c + 1]++] = static_cast<std::uint32_t>(i); });
    top_.assign(columns, -1);
    for (std::size_t c = 0; c < columns; ++c)
        for (int w = cells_[2] - 1; w >= 0 && top_[c] < 0; --w) {
            const std::size_t at = c * cells_[2] + w;
            if (start_[at + 1] > start_[at]) top_[c] = w;
        }
}

namespace {

constexpr std::size_t kMostCasters = 24;
// Neighbours take this many times as much light as they would alone, because they also stand for the grains
// farther away.
constexpr float kFarther = 1.3f;

NearGrain neighbour(const ViewSphere& own, const ViewSphere& other, float weight) {
    return {other.x - own.x, other.y - own.y,  other.z - own.z,
            other.radius,    1 / other.radius, other.radius * other.radius,
            weight};
}

}  // namespace

// How much light a neighbour takes. The weight is kFarther up to half of the neighbour's reach, and falls
// from there to 0 at the end of the reach, so that no neighbour appears or vanishes suddenly.
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
    grid_.around(own, kReach, [&](std::uint32_t j) {
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
    grid_.clear();
    if (!lamp.occlusion && !lamp.shadows) return;
    grid_.fill(spheres, lamp, kWallReach);
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
