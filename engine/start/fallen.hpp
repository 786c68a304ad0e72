// Grains that fall into an exit, and out of reach of every wall, while the bed is packed. Exits act from the
// start of the drive on, so these grains must wait for it.
#pragma once

#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

class FallenGrains {
  public:
    // The scene must outlive this object.
    FallenGrains(const Scene& scene, const Surroundings& around);

    // Stops the grains that are in an exit and below all walls, so that they are still in the exit when the
    // drive starts. Without this they would fall on and on, and through the exit. Call it between two runs of
    // the step loop.
    void stop(Grains& grains) const;

  private:
    const Scene& scene_;
    Vec3 down_{0, 0, -1};     // unit, along gravity
    bool none_falls_ = true;  // without exits, without gravity, and above a plane that holds all grains
    double lowest_ = 0;       // m, along `down_`: no wall is farther down
};

}  // namespace grainreel
