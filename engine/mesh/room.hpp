// The room that a surface encloses, where grains can be: in a closed vessel, in an open one, in a hopper
// without a bottom, and in one whose walls have a thickness.
//
// A place is enclosed when rays to all sides (sixteen, level) meet the surface. What is enclosed is told
// apart by how many closed parts of the surface are around it (its winding number): the room of a cup with
// thick walls is inside none, the wall inside one; the room of a closed drum is inside one, a solid lifter in
// it inside two. The room is what is inside the fewest, if that is a fifth of all that is enclosed; else what
// has the largest volume. Parts that are not closed (sheets, open hoppers, baffles) enclose, but have no
// inside.
//
// Sizes come from sections at 256 heights and more, each exact for its polygon: two in each slice, between
// all heights at which the surface has level faces. Volumes of boxes and prisms are exact, of cones to 1e-4.
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

// A grid of 32 x 32 x 32 cells that answers at once for most places of a room. All places of a cell without
// surface have one answer, and so have the cells beyond its sides at the same height.
class RoomGrid {
  public:
    enum class Answer : std::uint8_t { unknown, inside, outside };

    RoomGrid() = default;
    // `holds`: whether a place is in the room. It is asked for up to 64 places of each region of cells
    // without surface; where they differ (near a hole in a wall), that region stays unknown.
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

    bool holds(const Vec3& place) const;                 // lid or not; never below base() or above top()
    bool holds(const Vec3& place, double margin) const;  // and at least so far (m) from the surface
    bool encloses_anything() const { return volume() > 0; }

    double base() const { return base_; }  // m, z of the lowest enclosed place
    double top() const { return top_; }    // m, z of the highest one: lid or rim
    double volume() const {
        return slices_.empty() ? 0 : slices_.back().volume_below + slices_.back().volume;
    }                                     // m3
    double volume_below(double z) const;  // m3, of the room below z (m)
    double area_at(double z) const;       // m2, of its level section
    // m: half the width along y, and half the depth along x, of the room at that height.
    double half_width_at(double z) const;
    double half_depth_at(double z) const;
    const std::string& hash() const { return surface_->hash(); }
    // A ray upwards (downwards) from the widest place meets nothing.
    bool open_above() const { return open_above_; }
    bool open_below() const { return open_below_; }
    // m, in it, and far from the surface.
    const Vec3& widest_place() const { return widest_; }

  private:
    // A number that is known at two heights of a slice, and on the straight line through them elsewhere in
    // it.
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
    int winding_ = 0;  // of the room
    double base_ = 0, top_ = 0;
    std::vector<Slice> slices_;  // rising, without gaps
    Vec3 widest_{0, 0, 0};
    RoomGrid grid_;
    bool open_above_ = false, open_below_ = false;
};

}  // namespace grainreel
