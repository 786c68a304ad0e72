#include "engine/mesh/room.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/mesh/level_section.hpp"

namespace grainreel {

// Numbers of the level directions (level_direction()) in which rays are sent for the winding number. The
// first answer that two rays agree on is taken, so three rays are enough.
constexpr std::array<int, 3> tried{1, 7, 11};

bool EnclosedRoom::holds(const Vec3& place) const {
    if (slices_.empty() || !(place.z() >= base_ && place.z() <= top_)) return false;
    const RoomGrid::Answer answer = grid_.at(place);
    return answer == RoomGrid::Answer::unknown ? holds_by_rays(place) : answer == RoomGrid::Answer::inside;
}

bool EnclosedRoom::holds_by_rays(const Vec3& place) const {
    for (int i = 0; i < 2 * kLevelAxes; ++i)
        if (!surface_->meets(place, level_direction(i))) return false;
    if (!any_closed_) return true;
    int agree = 0, differ = 0;
    for (const int i : tried) {
        ++(winding_along(place, level_direction(i)) == winding_ ? agree : differ);
        if (agree == 2 || differ == 2) break;
    }
    return agree > differ;
}

bool EnclosedRoom::holds(const Vec3& place, double margin) const {
    return holds(place) && !surface_->any_within(place, margin);
}

std::optional<int> EnclosedRoom::winding_along(const Vec3& place, const Vec3& direction) const {
    thread_local std::vector<Surface::Hit> hits;
    hits.clear();
    surface_->all_hits(place, direction, hits);
    if (hits.empty()) return std::nullopt;
    int winding = 0;
    for (const Surface::Hit& hit : hits)
        if (closed_[hit.triangle]) winding += hit.front ? -1 : 1;
    return winding;
}

const EnclosedRoom::Slice* EnclosedRoom::slice_at(double z) const {
    if (slices_.empty() || !(z >= base_ && z <= top_)) return nullptr;
    const auto above = std::upper_bound(slices_.begin(), slices_.end(), z,
                                        [](double height, const Slice& slice) { return height < slice.low; });
    return above == slices_.begin() ? &slices_.front() : &above[-1];
}

// The value at height z of a number that is linear within a slice, and is stored at the two heights of
// Gauss's rule.
double EnclosedRoom::value_at(double z, Line Slice::*line) const {
    const Slice* const slice = slice_at(z);
    if (slice == nullptr) return 0;
    const Line& values = slice->*line;
    const double middle = 0.5 * (slice->low + slice->high),
                 apart = (slice->high - slice->low) / std::sqrt(3.0);
    const double slope = (values.at_second - values.at_first) / apart;
    return std::max(0.0, 0.5 * (values.at_first + values.at_second) + slope * (z - middle));
}

double EnclosedRoom::volume_below(double z) const {
    if (slices_.empty() || z <= base_) return 0;
    if (z >= top_) return volume();
    const Slice& slice = *slice_at(z);
    // The area is linear within the slice, and its value at the top follows from the slice's volume. If that
    // value is cut off at 0, the result is scaled to keep the volume.
    const double low = std::max(0.0, value_at(slice.low, &Slice::area)), here = value_at(z, &Slice::area);
    const double high = std::max(0.0, 2 * slice.volume / (slice.high - slice.low) - low);
    const double whole = 0.5 * (low + high) * (slice.high - slice.low);
    const double part = std::clamp(0.5 * (low + here) * (z - slice.low), 0.0, whole);
    return slice.volume_below + (whole > 0 ? slice.volume * part / whole : 0);
}

double EnclosedRoom::area_at(double z) const {
    return value_at(z, &Slice::area);
}

double EnclosedRoom::half_width_at(double z) const {
    return value_at(z, &Slice::half_width);
}

double EnclosedRoom::half_depth_at(double z) const {
    return value_at(z, &Slice::half_depth);
}

namespace {

// How many places of a region of cells are tested. The level sections of a closed surface are closed lines,
// so a region is inside or outside as a whole and few places are enough.
constexpr std::size_t asked_of_closed = 2, asked_of_open = 32;

std::size_t cells_of(int across) {
    return static_cast<std::size_t>(across) * static_cast<std::size_t>(across) *
           static_cast<std::size_t>(across);
}

}  // namespace

RoomGrid::RoomGrid(const Surface& surface, const Eigen::AlignedBox3d& box,
                   const std::function<bool(const Vec3&)>& holds)
    : box_(box), width_(box.sizes() / kAcross) {
    if (!(width_.minCoeff() > 0)) return;
    free_.assign(cells_of(kAcross), 0);
    constexpr int step = kAcross / kCoarse;
    for (int z = 0; z < kAcross; z += step)
        for (int y = 0; y < kAcross; y += step)
            for (int x = 0; x < kAcross; x += step) mark_free(surface, {x, y, z}, step);
    answers_.assign(cells_of(kAcross), Answer::unknown);
    for (std::size_t i = 0; i < free_.size(); ++i)
        if (free_[i])
            answer_region(static_cast<std::int32_t>(i), holds,
                          surface.facts().closed() ? asked_of_closed : asked_of_open);
    free_ = {};
}

Vec3 RoomGrid::middle(const std::array<int, 3>& first, int size) const {
    return box_.min() + width_.cwiseProduct(Vec3(first[0], first[1], first[2]) + Vec3::Constant(0.5 * size));
}

// Marks a block of cells as free if it has no surface. Otherwise it tries the block's eight parts.
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
            for (int x = first[0]; x < first[0] + size; ++x) free_[(z * kAcross + y) * kAcross + x] = 1;
}

// A region is one layer of cells high. A place is judged by level rays alone, so the answer may change from
// one height to the next.
void RoomGrid::answer_region(std::int32_t seed, const std::function<bool(const Vec3&)>& holds,
                             std::size_t most) {
    std::vector<std::int32_t> region{seed};
    free_[seed] = 0;
    for (std::size_t next = 0; next < region.size(); ++next) {
        const std::int32_t cell = region[next];
        std::int32_t place = cell, step = 1;
        for (int k = 0; k < 2; ++k, place /= kAcross, step *= kAcross)
            for (const int way : {-1, 1}) {
                const int there = place % kAcross + way;
                if (there < 0 || there >= kAcross || !free_[cell + way * step]) continue;
                free_[cell + way * step] = 0;
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
    for (const std::int32_t cell : region) answers_[cell] = inside > 0 ? Answer::inside : Answer::outside;
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
