// Which grains lie beside the left wall of the container, and which beside the right one.
#pragma once

#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

enum class Side { left, right, none };

// Slants count as walls, and the halves y < 0 and y > 0 of a cylinder's wall as left and right. Front and
// back do not count: in a narrow bed every grain is beside them.
class SideWalls {
  public:
    // A grain lies beside a wall when no grain of the smallest mean diameter fits between the two.
    explicit SideWalls(const Scene& scene);

    bool any() const { return !faces_.empty(); }
    Side side_of(const Place& grain, const Pose& pose) const;

  private:
    std::vector<Face> faces_;
    double gap_ = 0;  // m
};

}  // namespace grainreel
