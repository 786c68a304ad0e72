// Checks the grains that a user of the library adds to a run: their numbers, and whether there is room for
// them.
#pragma once

#include "engine/library/internal.hpp"

#include "engine/state/traffic.hpp"
#include "engine/step/surroundings.hpp"
#include "grainreel/simulation.hpp"

namespace grainreel::v1 {

// The room of a scene for new grains at one step of its run, with the grains that are there.
class RoomForGrains {
  public:
    // `now` has the grains that are there. All three must outlive this object.
    RoomForGrains(const grainreel::Scene& scene, const Plan& plan, const grainreel::State& now);

    // Throws Error where the grain has a number that it cannot have, touches a grain or a wall, or lies
    // outside the container or inside a closed mesh. The grain counts as being there from now on.
    grainreel::ComingGrain take(const NewGrain& grain);

  private:
    void check_walls(const grainreel::ComingGrain& grain) const;
    void check_meshes(const grainreel::ComingGrain& grain) const;
    void check_other(const grainreel::ComingGrain& grain, const Vec3& other, double radius,
                     const char* what) const;

    const grainreel::Scene& scene_;
    const grainreel::State& now_;
    Surroundings around_;
    grainreel::DrivePose pose_;
    std::vector<grainreel::ComingGrain> taken_;
};

}  // namespace grainreel::v1
