// The room for grains that a surface encloses. The surface may be a closed vessel, an open one, a hopper
// without a bottom, or a vessel whose walls have a thickness.
//
// A place is enclosed when sixteen level rays, to all sides, meet the surface. Enclosed regions differ in
// the number of closed parts of the surface around them (the winding number). The room of a cup with thick
// walls is inside none, and the wall is inside one. The room of a closed drum is inside one, and a solid
// lifter in it is inside two. The room is the region with the lowest winding number if it has at least a
// fifth of the enclosed volume; otherwise it is the region with the largest volume. Parts that are not closed
// (sheets, open hoppers, baffles) enclose, but have no inside.
//
// Sizes come from level sections at some 128 heights or more. A section is the polygon in which a plane cuts
// the surface, and its area is exact. There are two sections in each slice of the room. Slices end at the
// heights of vertices or, if these are more than 64, at those of the largest level faces. Volumes of boxes
// and prisms are exact, and volumes of cones are exact to 1e-4.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/mesh/surface.hpp"

namespace grainreel {

// A grid of 32 x 32 x 32 cells that says for most places whether they are in the room, without a ray. Cells
// of one height that touch each other and have no surface in them form a region, which has one answer.
class RoomGrid {
  public:
    enum class Answer : std::uint8_t { unknown, inside, outside };

    RoomGrid() = default;
    // `holds` says whether a place is in the room. It is called for two places of each region of cells
    // without surface, or for 32 where the surface has holes. If its answers differ (near a hole in a wall),
    // that region stays unknown.
    RoomGrid(const Surface& surface, const Eigen::AlignedBox3d& box,
             const std::function<bool(const Vec3&)>& holds);

    Answer at(const Vec3& place) const;

  private:
    static constexpr int kAcross = 32, kCoarse = 4;
    void mark_free(const Surface& surface, const std::array<int, 3>& first, int size);
    void answer_region(std::int32_t seed, const std::function<bool(const Vec3&)>& holds, std::size_t most);
    Vec3 middle(const std::array<int, 3>& first, int size) const;

    Eigen::AlignedBox3d box_;
    Vec3 width_{0, 0, 0};          // m, of a cell
    std::vector<Answer> answers_;  // x fastest
    std::vector<char> free_;       // cells without surface that have no answer yet
};

class EnclosedRoom {
  public:
    explicit EnclosedRoom(std::shared_ptr<const Surface> surface);

    bool holds(const Vec3& place) const;  // with or without a lid; never below base() or above top()
    bool holds(const Vec3& place, double margin) const;  // also at least `margin` (m) from the surface
    bool encloses_anything() const { return volume() > 0; }

    double base() const { return base_; }  // m, z of the lowest enclosed place
    double top() const { return top_; }    // m, z of the highest one: lid or rim
    double volume() const {
        return slices_.empty() ? 0 : slices_.back().volume_below + slices_.back().volume;
    }                                     // m3
    double volume_below(double z) const;  // m3, volume of the room below z (m)
    double area_at(double z) const;       // m2, area of its level section
    // Half the width along y and half the depth along x of the room at that height, in m.
    double half_width_at(double z) const;
    double half_depth_at(double z) const;
    const std::string& hash() const { return surface_->hash(); }
    // Whether a ray upwards (or downwards) from the widest place meets nothing.
    bool open_above() const { return open_above_; }
    bool open_below() const { return open_below_; }
    // A place (m) in the room, far from the surface.
    const Vec3& widest_place() const { return widest_; }

  private:
    // A number that is known at two heights of a slice, and follows the straight line through them in the
    // rest of the slice.
    struct Line {
        double at_first = 0, at_second = 0;
    };
    // The room between two heights (m).
    struct Slice {
        double low, high;
        Line area, half_width, half_depth;    // m2, m, m
        double volume = 0, volume_below = 0;  // m3
    };
    struct Level;
    class Builder;

    const Slice* slice_at(double z) const;
    double value_at(double z, Line Slice::*line) const;
    bool holds_by_rays(const Vec3& place) const;
    std::optional<int> winding_along(const Vec3& place, const Vec3& direction) const;

    std::shared_ptr<const Surface> surface_;
    std::vector<char> closed_;  // for each triangle, whether its part has an inside
    bool any_closed_ = false;
    int winding_ = 0;  // winding number of the room
    double base_ = 0, top_ = 0;
    std::vector<Slice> slices_;  // rising, without gaps
    Vec3 widest_{0, 0, 0};
    RoomGrid grid_;
    bool open_above_ = false, open_below_ = false;
};

}  // namespace grainreel
