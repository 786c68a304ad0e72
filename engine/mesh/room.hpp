// The room that a surface encloses, where grains can be: in a closed vessel, in an open one, in a hopper
// without a bottom, and in one whose walls have a thickness.
//
// A place is enclosed when rays to all sides (sixteen, level) meet the surface. In walls with a thickness a ray
// crosses another number of faces than in the room. So a place counts when it is enclosed and its level ray
// crosses the surface an even or odd number of times, as it does at the widest enclosed place.
#pragma once

#include <memory>
#include <vector>

#include "engine/mesh/surface.hpp"

namespace grainreel {

class EnclosedRoom {
  public:
    explicit EnclosedRoom(std::shared_ptr<const Surface> surface);

    bool holds(const Vec3& place) const;                 // any height, lid or not
    bool holds(const Vec3& place, double margin) const;  // and at least so far (m) from the surface
    bool encloses_anything() const { return volume() > 0; }

    double base() const { return base_; }  // m, z of the lowest enclosed place
    double top() const { return top_; }    // m, z of the highest one: lid or rim
    double volume() const;                 // m3
    double volume_below(double z) const;   // m3, of the room below z (m)
    double area_at(double z) const;        // m2, of its level section
    // m: half the width along y, and half the depth along x, of the room at that height.
    double half_width_at(double z) const;
    double half_depth_at(double z) const;
    const std::string& hash() const { return surface_->hash(); }
    bool open_above() const;  // a ray upwards from the widest place meets nothing

  private:
    std::shared_ptr<const Surface> surface_;
    double base_ = 0, top_ = 0;
    bool odd_ = true;
    std::vector<double> heights_, volumes_, areas_, half_widths_, half_depths_;  // in levels, rising
};

}  // namespace grainreel
