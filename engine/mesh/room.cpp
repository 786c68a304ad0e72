#include "engine/mesh/room.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/mesh/level_section.hpp"

namespace grainreel {

// Rays that are tried for the winding number; two that agree decide.
constexpr std::array<int, 5> tried{1, 7, 11, 5, 14};

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
        if (closed_[static_cast<std::size_t>(hit.triangle)]) winding += hit.front ? -1 : 1;
    return winding;
}

const EnclosedRoom::Slice* EnclosedRoom::slice_at(double z) const {
    if (slices_.empty() || !(z >= base_ && z <= top_)) return nullptr;
    const auto above = std::upper_bound(slices_.begin(), slices_.end(), z,
                                        [](double height, const Slice& slice) { return height < slice.low; });
    return above == slices_.begin() ? &slices_.front() : &above[-1];
}

// The two heights are those of Gauss's rule.
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
    // The line's part, stretched so that a whole slice has its own volume.
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

}  // namespace grainreel
