#include "engine/mesh/room_grid.hpp"

#include <algorithm>

namespace grainreel {
namespace {

// The level sections of a closed surface are closed lines: a region is inside or outside as a whole.
constexpr std::size_t asked_of_closed = 2, asked_of_open = 32;

std::size_t cells(int across) {
    return static_cast<std::size_t>(across) * static_cast<std::size_t>(across) *
           static_cast<std::size_t>(across);
}

}  // namespace

RoomGrid::RoomGrid(const Surface& surface, const Eigen::AlignedBox3d& box,
                   const std::function<bool(const Vec3&)>& holds)
    : box_(box), width_(box.sizes() / kAcross) {
    if (!(width_.minCoeff() > 0)) return;
    free_.assign(cells(kAcross), 0);
    constexpr int step = kAcross / kCoarse;
    for (int z = 0; z < kAcross; z += step)
        for (int y = 0; y < kAcross; y += step)
            for (int x = 0; x < kAcross; x += step) mark_free(surface, {x, y, z}, step);
    answers_.assign(cells(kAcross), Answer::unknown);
    for (std::size_t i = 0; i < free_.size(); ++i)
        if (free_[i])
            answer_region(static_cast<std::int32_t>(i), holds,
                          surface.facts().closed() ? asked_of_closed : asked_of_open);
    free_ = {};
}

Vec3 RoomGrid::middle(const std::array<int, 3>& first, int size) const {
    return box_.min() + width_.cwiseProduct(Vec3(first[0], first[1], first[2]) + Vec3::Constant(0.5 * size));
}

// A block of cells without surface is free as a whole; any other one is halved.
void RoomGrid::mark_free(const Surface& surface, const std::array<int, 3>& first, int size) {
    const double radius = 0.5 * size * width_.norm() * (1 + 1e-9);
    if (surface.any_within(middle(first, size), radius)) {
        const int half = size / 2;
        for (int i = 0; half > 0 && i < 8; ++i)
            mark_free(surface,
                      {first[0] + (i & 1) * half, first[1] + (i >> 1 & 1) * half, first[2] + (i >> 2) * half},
                      half);
        return;
    }
    for (int z = first[2]; z < first[2] + size; ++z)
        for (int y = first[1]; y < first[1] + size; ++y)
            for (int x = first[0]; x < first[0] + size; ++x)
                free_[static_cast<std::size_t>((z * kAcross + y) * kAcross + x)] = 1;
}

// A region lies in one layer of cells, because rays to all sides are level.
void RoomGrid::answer_region(std::int32_t seed, const std::function<bool(const Vec3&)>& holds,
                             std::size_t most) {
    std::vector<std::int32_t> region{seed};
    free_[static_cast<std::size_t>(seed)] = 0;
    for (std::size_t next = 0; next < region.size(); ++next) {
        const std::int32_t cell = region[next];
        std::int32_t place = cell, step = 1;
        for (int k = 0; k < 2; ++k, place /= kAcross, step *= kAcross)
            for (const int way : {-1, 1}) {
                const int there = place % kAcross + way;
                if (there < 0 || there >= kAcross || !free_[static_cast<std::size_t>(cell + way * step)])
                    continue;
                free_[static_cast<std::size_t>(cell + way * step)] = 0;
                region.push_back(cell + way * step);
            }
    }
    std::size_t inside = 0;
    const std::size_t asked = std::min(region.size(), most);
    for (std::size_t i = 0; i < asked; ++i) {
        const std::int32_t cell = region[i * region.size() / asked];
        inside += holds(middle({cell % kAcross, cell / kAcross % kAcross, cell / kAcross / kAcross}, 1));
        if (inside != 0 && inside != i + 1) return;
    }
    for (const std::int32_t cell : region)
        answers_[static_cast<std::size_t>(cell)] = inside > 0 ? Answer::inside : Answer::outside;
}

RoomGrid::Answer RoomGrid::at(const Vec3& place) const {
    if (answers_.empty() || !box_.contains(place)) return Answer::unknown;
    const Vec3 scaled = (place - box_.min()).cwiseQuotient(width_);
    std::size_t cell = 0;
    for (int k = 2; k >= 0; --k)
        cell = cell * kAcross + static_cast<std::size_t>(std::min(scaled[k], kAcross - 1.0));
    return answers_[cell];
}

}  // namespace grainreel
