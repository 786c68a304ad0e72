// The room that a container and the scene's own planes leave to grains.
#pragma once

#include <vector>

#include "engine/scene/scene.hpp"

namespace grainreel {

class FreeSpace {
  public:
    // With planes of its own the scene's room is measured at 100,000 evenly spread places: volumes are then
    // good to some 0.1 % of the container's.
    explicit FreeSpace(const Scene& scene);

    double volume() const { return volume_; }  // m3
    // m: z below which the share of the volume lies; share in [0, 1].
    double height_of_share(double share) const;
    // Whether the place lies at least `margin` (m) from floor, lid, walls and planes.
    bool holds(const Vec3& place, double margin) const;

  private:
    bool before_planes(const Vec3& place, double margin) const;

    const Container container_;
    const std::vector<FreeWall> planes_;
    double volume_;
    std::vector<double> heights_;  // of the places with room, rising; unused without planes
};

}  // namespace grainreel
